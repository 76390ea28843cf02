#include "core/motion/equilibrium.h"
#include "parallel/stages.h"
#include "verification/unit/case_run.h"

#include <cmath>

namespace hdem
{
namespace
{
using test::CaseRun;

TEST(KineticEnergy, CountsTranslationAndRotationOfFreeBlocks)
{
    CaseDef scene = scenes::stack(2);
    scene.blocks[1].velocity = {3.0, 4.0};
    scene.blocks[2].angular_velocity = 2.0;
    const CaseRun run(scene);
    const Equilibrium sums = run.simulation.equilibrium();
    EXPECT_NEAR(sums.kinetic_energy, 0.5 * 2700.0 * 25.0 + 0.5 * 450.0 * 4.0, 1e-9);
    EXPECT_NEAR(sums.free_mass, 5400.0, 1e-9);
    EXPECT_NEAR(sums.greatest_speed, 5.0, 1e-15);
    EXPECT_NEAR(sums.kinetic_energy_at(5e-4), 0.5 * 5400.0 * 25e-8, 1e-15);
}

/// Weight and loads of a block add up before their size is taken; a load counts as long as it acts.
TEST(AppliedForce, IsWeightAndLoadsOfFreeBlocks)
{
    CaseDef scene = scenes::stack(2);
    LoadDef load{.blocks = {"block1"}, .acceleration = {3.0, 0.0}, .force = {0.0, 487.0}};  // against 26487 N of weight
    load.interval.from_cycle = 1;
    load.interval.until_cycle = 3;
    scene.loads.push_back(load);
    CaseRun run(scene);
    const double weight = 2700.0 * 9.81;
    const double loaded = std::hypot(3.0 * 2700.0, weight - 487.0);
    for (const double expected : {2.0 * weight, weight + loaded, weight + loaded, 2.0 * weight})
    {
        run.advance(1);
        EXPECT_NEAR(run.simulation.equilibrium().applied_force, expected, 1e-9) << "cycle " << run.state().cycle;
    }
}

/// Tractions that cancel each other leave round-off, which is no scale: by it a block at rest was out of balance for ever.
TEST(AppliedForce, IsNothingWhereLoadsCancel)
{
    for (const double angle : {0.0, 37.0, 90.0, 161.0})
    {
        CaseDef scene = scenes::stack(2);
        scene.loads = {{.blocks = {"block1"}, .force = {2.1e6, 0.0}},
                       {.blocks = {"block1"}, .force = {-0.7e6, 0.0}},
                       {.blocks = {"block1"}, .force = {-1.4e6, 0.0}}};
        scene = scenes::turned(scene, angle);
        scene.gravity = {0.0, 0.0};
        CaseRun run(scene);
        run.advance(1);
        const Equilibrium sums = run.simulation.equilibrium();
        EXPECT_EQ(sums.applied_force, 0.0) << angle;
        EXPECT_LT(sums.unbalanced.value, 1e-9) << angle;
        EXPECT_LT(sums.unbalanced_force_ratio(), 1e-9) << angle;
    }
}

TEST(UnbalancedForceRatio, IsOneInFreeFallAndNothingAtRest)
{
    CaseDef scene = scenes::block_on_ground();
    for (Vec2& p : scene.blocks[1].polygon)
        p.y() += 0.01;
    scene.contact.method = Method::force;
    CaseRun run(scene);
    run.advance(1);
    EXPECT_DOUBLE_EQ(run.simulation.equilibrium().unbalanced_force_ratio(), 1.0);
    run.advance(20000);
    EXPECT_LT(run.simulation.equilibrium().unbalanced_force_ratio(), 1e-6);
}

/// Impulses count as forces J / dt: a block at rest on impulses is in equilibrium too.
TEST(UnbalancedForceRatio, IsNothingAtRestOnImpulses)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::impulse;
    CaseRun run(scene);
    run.advance(500);
    EXPECT_LT(run.simulation.equilibrium().unbalanced_force_ratio(), 1e-3) << "one sweep too few leaves a thousandth";
}

TEST(Convergence, NeedsAllCriteriaListed)
{
    ConvergenceDef criteria{
        .criteria = {"kinetic_energy", "unbalanced_force_ratio"}, .mean_speed = 1e-3, .unbalanced_force_ratio = 1e-2};
    Equilibrium now{.kinetic_energy = 1e-6, .unbalanced_force = 1.0, .applied_force = 1000.0, .free_mass = 10.0};  // limit 5e-6 J
    EXPECT_TRUE(holds(criteria, now));
    now.kinetic_energy = 1e-5;
    EXPECT_FALSE(holds(criteria, now));
    now.kinetic_energy = 1e-6;
    now.unbalanced_force = 11.0;
    EXPECT_FALSE(holds(criteria, now));
    criteria.criteria = {"kinetic_energy"};
    EXPECT_TRUE(holds(criteria, now));
    criteria.criteria = {};
    EXPECT_FALSE(holds(criteria, now)) << "nothing asked for is nothing reached";
}

/// A block far above the ground beside one at rest on it.
TEST(Convergence, MayBeOfStandingBlocksOnly)
{
    for (const ConvergenceBlocks which : {ConvergenceBlocks::all, ConvergenceBlocks::standing})
    {
        CaseDef scene = scenes::block_on_ground();
        scenes::add_block(scene, "falling", scenes::rectangle({-1.9, 5.0}, {-0.9, 6.0}));
        scene.convergence.blocks = which;
        scene.convergence.loose_distance = 0.2;
        scene.convergence.least_cycles = 1;
        scene.stages[0].cycles.reset();
        scene.stages[0].until_converged = true;
        CaseRun run(scene);
        const auto results = run_stages(run.simulation, {});
        const double fallen = -run.displacement("falling").y();
        ASSERT_TRUE(results[0].at_rest);
        EXPECT_NEAR(run.simulation.equilibrium().free_mass, which == ConvergenceBlocks::all ? 5400.0 : 2700.0, 1e-9);
        EXPECT_GT(fallen, 0.2);
        EXPECT_EQ(fallen > 4.9, which == ConvergenceBlocks::all) << fallen << " m";
    }
}

TEST(Convergence, OfStandingBlocksWaitsForAllWhereNoneStands)
{
    CaseDef scene = scenes::block_on_ground();
    for (Vec2& p : scene.blocks[1].polygon)
        p.y() += 1.0;
    scene.convergence.blocks = ConvergenceBlocks::standing;
    scene.convergence.loose_distance = 0.2;
    scene.convergence.least_cycles = 1;
    scene.stages[0].cycles.reset();
    scene.stages[0].until_converged = true;
    scene.stages[0].max_cycles = 100000;
    CaseRun run(scene);
    ASSERT_TRUE(run_stages(run.simulation, {})[0].at_rest);
    EXPECT_NEAR(run.displacement("block").y(), -1.0, 1e-4) << "it has landed";
}

TEST(DisplacementReport, CountsWhatStayedAndNamesWhatDetached)
{
    CaseDef scene = scenes::stack(3);
    scene.convergence.detached_distance = 0.1;
    CaseRun run(scene, [](const Model&, State&) {});
    State state = run.state();
    const auto move = [&](const std::string& name, double by) { state.blocks.motion[run.slot(name)].x += by; };
    move("block1", 0.01);
    move("block2", 0.03);
    move("block3", 0.5);
    const DisplacementReport report = report_displacements(run.model(), state);
    EXPECT_EQ(report.counted, 3);
    EXPECT_NEAR(report.mean, 0.18, 1e-15);
    EXPECT_NEAR(report.greatest, 0.5, 1e-15) << "without an excavation detached ones count";
    EXPECT_EQ(report.detached, std::vector<Index>{run.slot("block3")});
    EXPECT_TRUE(report.before.empty());
    state.blocks.reference_position[run.slot("block3")].x() += 0.5;  // a stage begins
    EXPECT_TRUE(report_displacements(run.model(), state).detached.empty());
    EXPECT_EQ(report_displacements(run.model(), state).before, std::vector<Index>{run.slot("block3")});
    state.blocks.reference_position[run.slot("block3")].x() -= 0.5;
    state.next_to_excavation = {run.slot("block1"), run.slot("block3")};
    const DisplacementReport near = report_displacements(run.model(), state);
    EXPECT_EQ(near.counted, 1);
    EXPECT_NEAR(near.mean, 0.01, 1e-15);
    EXPECT_NEAR(near.mean_all, 0.18, 1e-15);
    EXPECT_NEAR(near.greatest_all, 0.5, 1e-15);
}
}  // namespace
}  // namespace hdem
