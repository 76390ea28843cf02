#include "core/motion/equilibrium.h"
#include "core/motion/rest.h"
#include "core/motion/time_step.h"
#include "core/stage/rules.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double step = 1e-4;

/// Three blocks on each other, in a stage that looks for rest.
CaseDef resting_stack(Method method = Method::hybrid)
{
    CaseDef scene = scenes::stack(3);
    scene.time.step = step;
    scene.contact.method = method;
    scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 100'000}};
    return scene;
}

/// A room in jointed rock: some blocks come to rest at once, others later.
CaseDef room()
{
    CaseDef scene = scenes::joints(20.0, 20.0, 1.0, 3.0);
    scene.excavations = {{.name = "room", .shape = OutlineShape::circle, .position = {10.0, 10.0}, .diameter = 5.0}};
    scene.time.step = step;
    scene.stages = {{.name = "dig", .until_converged = true, .max_cycles = 100'000, .excavate = {"room"}}};
    return scene;
}

Index count_left_out(const Blocks& blocks)
{
    return static_cast<Index>(std::count(blocks.rest.begin(), blocks.rest.end(), left_out));
}

bool is_left_out(const CaseRun& run, const std::string& name)
{
    return run.state().blocks.rest[run.slot(name)] == left_out;
}

/// Until so many blocks are left out.
void settle(CaseRun& run, Index blocks)
{
    while (count_left_out(run.state().blocks) < blocks && run.state().cycle < 30'000)
        run.advance(1);
    ASSERT_EQ(count_left_out(run.state().blocks), blocks) << "within " << run.state().cycle << " cycles";
}

TEST(Rest, LeavesAStackOutAndKeepsWhatItCarriesToTheBit)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseRun run(resting_stack(method));
        settle(run, 3);
        run.advance(1);  // in which the last contacts are evaluated at rest
        const State before = run.state();
        const std::uint64_t hash = run.hash();
        const std::int64_t evaluated = run.simulation.contact_point_updates();
        const EnergyLedger ledger = run.state().ledger;
        run.advance(1000);
        State after = run.state();
        EXPECT_EQ(after.cycle, before.cycle + 1000);
        after.cycle = before.cycle;  // only the clock has gone on
        after.time = before.time;
        after.blocks.step = before.blocks.step;
        EXPECT_EQ(state_hash(run.model(), after), hash);
        EXPECT_EQ(run.simulation.contact_point_updates(), evaluated);
        EXPECT_EQ(run.state().ledger.friction, ledger.friction);
        EXPECT_EQ(run.state().ledger.local_damping, ledger.local_damping);
        for (int k = 1; k <= 3; ++k)
        {
            const std::string name = "block" + std::to_string(k);
            EXPECT_EQ(run.velocity(name), Vec2(0.0, 0.0));
            EXPECT_EQ(run.motion(name).w, 0.0);
            const double weights = (4 - k) * 2700.0 * 9.81;
            const Vec2 forces = run.forces_between(name, k == 1 ? "ground" : "block" + std::to_string(k - 1));
            EXPECT_NEAR(forces.x(), weights, 0.01 * weights) << name;
        }
        EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-6);
    }
}

TEST(Rest, EndsInTheCycleInWhichAFallingBlockHits)
{
    CaseDef scene = resting_stack();
    scenes::add_block(scene, "hammer", scenes::rectangle({-0.4, 8.0}, {0.4, 9.0}));
    CaseRun run(scene);
    settle(run, 3);
    const Vec2 at = run.position("block3");
    while (run.forces_between("hammer", "block3").x() == 0.0 && run.state().cycle < 30'000)
    {
        EXPECT_TRUE(is_left_out(run, "block3"));
        EXPECT_EQ(run.position("block3"), at);
        run.advance(1);
    }
    EXPECT_GT(run.forces_between("hammer", "block3").x(), 0.0);
    EXPECT_EQ(run.state().blocks.rest[run.slot("block3")], 0);
    EXPECT_LT(run.velocity("block3").y(), 0.0);
    EXPECT_LT(run.position("block3").y(), at.y());
    EXPECT_TRUE(is_left_out(run, "block2")) << "nothing has reached it yet";
    run.advance(2);
    EXPECT_EQ(run.state().blocks.rest[run.slot("block2")], 0);
    EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-4);
    settle(run, 4);
    EXPECT_NEAR(run.displacement("hammer").y(), -5.0, 1e-3);
}

/// Nothing is left out for long that a stage may not end with.
TEST(RestRule, FollowsTheCriterionOfEachBlock)
{
    CaseDef scene = resting_stack();
    scene.convergence.block_unbalanced_ratio = 2e-4;
    const RestRule moving = resolve_rules(scene)[0].rest;
    EXPECT_TRUE(moving.leaves_out);
    EXPECT_LT(moving.quiet_speed, scene.convergence.mean_speed);
    EXPECT_LT(moving.quiet_on_average, moving.quiet);
    EXPECT_LT(moving.quiet, moving.waking);
    const RestRule calm = resolve_rules({.convergence = scene.convergence, .until_converged = true, .is_calm = true}).rest;
    EXPECT_LT(calm.waking, 9.81 * scene.convergence.unbalanced_force_ratio);
    EXPECT_LT(calm.quiet, calm.waking);
    EXPECT_LT(calm.waking, moving.quiet);
    EXPECT_EQ(calm.quiet, moving.quiet_at_end);
    scene.gravity = {0.0, 0.0};
    EXPECT_GT(resolve_rules(scene)[0].rest.quiet, 0.0) << "in space too";
}

TEST(Rest, IsTheSameOnAnyNumberOfThreadsAndAfterARestart)
{
    CaseRun one(room(), 1);
    while (count_left_out(one.state().blocks) <= 20 && one.state().cycle < 20'000)
        one.advance(1000);
    ASSERT_GT(count_left_out(one.state().blocks), 20) << "blocks rest when it breaks off";
    Simulation restarted(one.model(), one.state(), 2);
    constexpr std::int64_t more = 6000;
    const std::int64_t cycles = one.state().cycle + more;
    one.advance(more);
    restarted.advance(more);
    EXPECT_EQ(state_hash(restarted.model(), restarted.state()), one.hash());
    for (const int threads : {2, 3})
    {
        CaseRun many(room(), threads);
        many.advance(cycles);
        EXPECT_EQ(many.hash(), one.hash()) << threads << " threads";
        EXPECT_EQ(many.state().blocks.rest, one.state().blocks.rest);
        EXPECT_EQ(many.energy(), one.energy());
    }
}

/// A unit block on a slope of 30 degrees.
CaseRun on_slope(double friction_angle_deg)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[0].polygon = scenes::rectangle({-20.0, -1.0}, {20.0, 0.0});
    scene.gravity = 9.81 * Vec2(std::sin(radians(30.0)), -std::cos(radians(30.0)));
    scene.joints[0].friction_angle_deg = friction_angle_deg;
    scene.time.step = step;
    scene.convergence.loose_distance = 1e3;
    scene.stages = {{.name = "slide", .until_converged = true, .max_cycles = 100'000}};
    return CaseRun(scene);
}

/// Gravity less friction is 0.01 m/s2, below the limit of what is quiet, but never its speed.
TEST(Rest, IsNotForABlockThatSlidesSlowly)
{
    CaseRun sliding = on_slope(29.95);
    for (int i = 0; i < 20'000; ++i)
    {
        sliding.advance(1);
        ASSERT_LT(sliding.state().blocks.rest[sliding.slot("block")], stopped) << "cycle " << i;
    }
    EXPECT_GT(sliding.displacement("block").norm(), 1e-3);
    CaseRun holding = on_slope(31.0);
    settle(holding, 1);
}

TEST(Rest, IsForStagesThatLookForRestOnly)
{
    CaseDef timed = resting_stack(), dynamic = resting_stack(), paper = resting_stack(), loaded = resting_stack(),
            driven = resting_stack(), impulses = resting_stack(Method::impulse);
    timed.stages = {{.name = "rest", .cycles = 100'000}};
    dynamic.damping.preset = DampingPreset::dynamic;
    paper.damping.preset = DampingPreset::paper;
    loaded.loads.push_back({.blocks = {"block1"}, .acceleration = {0.0, 0.0}, .interval = {.until_cycle = 20'000}});
    scenes::add_fixed_block(driven, "plate", scenes::rectangle({5, 5}, {6, 6})).velocity = {0.1, 0.0};
    for (const CaseDef& scene : {timed, dynamic, paper, loaded, driven, impulses})
    {
        CaseRun run(scene);
        run.advance(15'000);
        EXPECT_EQ(count_left_out(run.state().blocks), 0);
    }
}

/// What is fixed of a block has no velocity then, or nothing rests at all.
TEST(Rest, OfAPartiallyFixedBlockLeavesItsPrescribedVelocityAlone)
{
    CaseDef scene = resting_stack();
    scene.blocks[3].fix_x = scene.blocks[3].fix_rotation = true;
    CaseRun held(scene);
    settle(held, 3);
    EXPECT_EQ(held.displacement("block3").x(), 0.0);
    scene.blocks[3].velocity = {1e-5, 0.0};
    CaseRun moved(scene);
    moved.advance(15'000);
    EXPECT_EQ(count_left_out(moved.state().blocks), 0);
    EXPECT_EQ(moved.velocity("block3").x(), 1e-5);
    EXPECT_NEAR(moved.displacement("block3").x(), 1e-5 * 15'000 * step, 1e-12);
}

/// A load of nothing that is still to end keeps all blocks awake.
TEST(Rest, ChangesTheAnswerByLessThanTheCriterionLeaves)
{
    CaseDef calm = room();
    calm.joints[0].friction_angle_deg = 50.0;  // nothing slides out
    calm.excavations[0].diameter = 3.0;
    {
        const CaseRun probe(calm);  // both then take the largest step there is
        calm.time.step = 0.9 * critical_time_step(probe.model(), probe.state().blocks, probe.state().contacts);
    }
    CaseDef awake = calm;
    awake.loads.push_back({.blocks = {}, .acceleration = {0.0, 0.0}, .interval = {.until_cycle = 20'000}});
    CaseRun with(calm), without(awake);
    constexpr std::int64_t cycles = 10'000;
    with.advance(cycles);
    without.advance(cycles);
    ASSERT_EQ(with.simulation.equilibrium().kinetic_energy, 0.0) << "all rests";
    ASSERT_EQ(count_left_out(without.state().blocks), 0);
    double moved = 0.0, apart = 0.0, most = 0.0, unequal = 0.0;
    for (Index b = 0; b < with.model().blocks(); ++b)
    {
        moved = std::max(moved, without.state().blocks.displacement(b).norm());
        apart = std::max(apart, (with.state().blocks.displacement(b) - without.state().blocks.displacement(b)).norm());
    }
    ASSERT_EQ(with.state().contacts.size(), without.state().contacts.size());
    for (Index i = 0; i < with.state().contacts.size(); ++i)
    {
        const ContactReport one = report_contact(with.state(), i), other = report_contact(without.state(), i);
        most = std::max(most, other.normal_force);
        unequal = std::max(unequal, std::abs(one.normal_force - other.normal_force));
    }
    EXPECT_LT(apart, 2.5e-6) << "m, of " << moved;
    EXPECT_LT(unequal, 0.02 * most) << "N, of " << most;
}
}  // namespace
}  // namespace hdem
