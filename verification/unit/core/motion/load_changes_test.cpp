#include "core/motion/loads.h"
#include "core/motion/rest.h"
#include "core/stage/load_changes.h"
#include "parallel/stages.h"
#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

constexpr double step = 1e-3;

/// A block alone, without weight and damping.
CaseDef alone()
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0.0, 0.0}, {1.0, 1.0}));
    scene.gravity = {0.0, 0.0};
    scene.damping.preset = DampingPreset::dynamic;
    scene.time.step = step;
    return scene;
}

/// Squares on a floor between rollers, pressed from above.
CaseDef pressed_squares(const FactorDef& factor)
{
    CaseDef scene = square_pattern(3.0, 3.0);
    scene.domain.fixed = {"bottom"};
    scene.boundaries = {side("left", BoundaryKind::roller), side("right", BoundaryKind::roller), pressed("top", 2e6)};
    scene.boundaries.back().factor = factor;
    scene.stages = {{.name = "press", .cycles = 3000}};
    return scene;
}

double pressure_below(const CaseRun& run)
{
    double force = 0.0;
    for (Index i = 0; i < run.state().contacts.size(); ++i)
    {
        const Contacts& contacts = run.state().contacts;
        if (run.state().blocks.is_free(contacts.ref[i]) == run.state().blocks.is_free(contacts.inc[i]))
            continue;
        const EdgePair edges = contacts.edges(i);
        const bool is_of_wall = run.model().is_wall(contacts.ref[i]) || run.model().is_wall(contacts.inc[i]);
        if (std::abs(edges.tx) > 0.5 && !is_of_wall)
            force += contacts.normal_force(0, i) + contacts.normal_force(1, i);
    }
    return force / 3.0;
}

TEST(Factor, IsLinearBetweenRowsAndConstantOutside)
{
    const Factor factor{.rows = {{10.0, 0.5}, {20.0, 1.0}, {40.0, -1.0}}};
    EXPECT_EQ(factor.at(-1, step), 0.5);
    EXPECT_EQ(factor.at(10, step), 0.5);
    EXPECT_EQ(factor.at(15, step), 0.75);
    EXPECT_EQ(factor.at(20, step), 1.0);
    EXPECT_EQ(factor.at(30, step), 0.0);
    EXPECT_EQ(factor.at(1000, step), -1.0);
    const Factor timed{.rows = {{0.0105, 0.0}, {0.0305, 1.0}}, .is_by_time = true};
    EXPECT_NEAR(timed.at(20, step), 0.475, 1e-12);
    EXPECT_EQ(timed.first_cycle(step), 10);
    EXPECT_EQ(timed.last_cycle(step), 31);
    EXPECT_EQ(Factor{}.at(7, step), 1.0);
}

/// Velocities live half a step before the forces: after n cycles v = F dt / m times the sum of the first n factors.
TEST(LoadChanges, ARampPushesByItsMean)
{
    CaseDef scene = alone();
    scene.loads = {{.blocks = {"block"}, .force = {270.0, 0.0}, .moment = 10.0, .factor = {.ramp_cycles = Vec2(100.0, 300.0)}}};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_EQ(run.velocity("block").x(), 0.0);
    run.advance(150);
    double sum = 0.0;
    for (int n = 0; n < 150; ++n)
        sum += n / 200.0;
    EXPECT_NEAR(run.velocity("block").x(), 0.1 * step * sum, 1e-14);
    EXPECT_NEAR(run.motion("block").w, 10.0 / run.model().inertia[0] * step * sum, 1e-14);
    EXPECT_LT(ledger_residual(run), 1e-12);
    run.advance(250);
    for (int n = 150; n < 400; ++n)
        sum += std::min(n / 200.0, 1.0);
    EXPECT_NEAR(run.velocity("block").x(), 0.1 * step * sum, 1e-13);
    const double kinetic = kinetic_energy(run.model(), run.state().blocks, 0);
    EXPECT_NEAR(run.state().ledger.load_work, kinetic, 1e-12 * kinetic) << "work is what it moves with";
}

TEST(LoadChanges, PrescribedVelocitiesFollowTheTable)
{
    CaseDef scene = alone();
    scene.blocks[0].fix_x = true;
    scene.loads = {{.blocks = {"block"},
                    .velocity_x = 0.5,
                    .factor = {.table = {{0.0, 0.0}, {0.1, 1.0}, {0.3, -1.0}}, .table_by = TableColumn::time}}};
    CaseRun run(scene);
    double x = 0.0;
    for (int n = 0; n < 400; ++n)
    {
        const double t = n * step, v = 0.5 * (t < 0.1 ? t / 0.1 : std::max(1.0 - (t - 0.1) / 0.1, -1.0));
        run.advance();
        x += v * step;
        ASSERT_NEAR(run.velocity("block").x(), v, 1e-12) << "cycle " << n;
        ASSERT_NEAR(run.displacement("block").x(), x, 1e-12);
    }
    EXPECT_LT(ledger_residual(run), 1e-12);
}

/// Cycles of an entry with `since` are those of its stage, and it does not act before.
TEST(LoadChanges, CountFromTheStageThatIsNamed)
{
    CaseDef scene = alone();
    scene.stages = {{.name = "first", .cycles = 37}, {.name = "second", .cycles = 50}, {.name = "third", .cycles = 20}};
    scene.loads = {{.blocks = {"block"},
                    .force = {2700.0, 0.0},
                    .interval = {.from_cycle = 10, .until_cycle = 60},
                    .factor = {.table = {{0.0, 0.0}, {20.0, 1.0}}, .since = "second"}}};
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
    run_stages(simulation, {});
    double sum = 0.0;
    for (int n = 10; n < 60; ++n)
        sum += std::min(n / 20.0, 1.0);
    EXPECT_NEAR(simulation.state().blocks.motion[0].vx, step * sum, 1e-13);
}

TEST(LoadChanges, TractionsGrowToTheSameStressWithoutSwinging)
{
    CaseRun slowly(pressed_squares({.ramp_cycles = Vec2(0.0, 1500.0)})), at_once(pressed_squares({}));
    double most = 0.0, most_at_once = 0.0;
    for (int i = 0; i < 3000; ++i)
    {
        slowly.advance();
        at_once.advance();
        most = std::max(most, stored_energy(slowly.model(), slowly.state()).kinetic);
        most_at_once = std::max(most_at_once, stored_energy(at_once.model(), at_once.state()).kinetic);
        if (i == 750)
        {
            EXPECT_NEAR(pressure_below(slowly), 1e6, 2e4);
        }
    }
    EXPECT_LT(most, 0.01 * most_at_once);
    EXPECT_NEAR(pressure_below(slowly), 2e6, 2e3);
    EXPECT_LT(ledger_residual(slowly), 1e-6);
}

TEST(LoadChanges, OfWallsAndTargetsFollowTheirFactor)
{
    CaseDef scene = pressed_squares({});
    scene.boundaries.back() = side("top", BoundaryKind::velocity);
    scene.boundaries.back().velocity = {0.0, -0.02};
    scene.boundaries.back().factor = {.table = {{0.0, 0.0}, {100.0, 1.0}, {200.0, 0.0}}};
    CaseRun run(scene);
    double way = 0.0;
    for (int n = 0; n < 300; ++n)
    {
        const double factor = n < 100 ? n / 100.0 : std::max(2.0 - n / 100.0, 0.0);
        way += factor * 0.02 * run.model().time_step;
        EXPECT_EQ(resolve_rules(run.model(), run.state()).moves_walls, n <= 200);
        run.advance();
        ASSERT_NEAR(-run.displacement("top").y(), way, 1e-12) << "cycle " << n;
    }
    EXPECT_LT(ledger_residual(run), 1e-6);
    scene.boundaries.back() = side("top", BoundaryKind::servo);
    scene.boundaries.back().target = 2e6;
    scene.boundaries.back().max_velocity = 0.05;
    scene.boundaries.back().factor = {.table = {{0.0, 0.2}, {3000.0, 0.2}, {6000.0, 1.0}}};
    CaseRun servo(scene);
    servo.advance(3000);
    EXPECT_NEAR(pressure_below(servo), 0.4e6, 0.4e4);
    servo.advance(6000);
    EXPECT_NEAR(pressure_below(servo), 2e6, 1e4);
    EXPECT_LT(ledger_residual(servo), 1e-6);
}

/// Steps vary from the first cycle on in which nothing changes any more. What is stable then has to be known in that cycle.
TEST(LoadChanges, TimeGoesOnOnceTheyAreOver)
{
    CaseDef scene = pressed_squares({.table = {{0.0, 0.5}, {777.0, 1.0}}});
    scene.insitu = {.given = true, .stress = StressDef{.xx = -1e6, .yy = -1e6}};
    scene.stages = {{.name = "press", .until_converged = true, .max_cycles = 100'000}};
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        run.advance(777);
        for (int n = 777; n < 1100; ++n)
        {
            const double before = run.state().time;
            run.advance();
            ASSERT_GT(run.state().time, before) << "cycle " << n << ", method " << name_of(method);
        }
        EXPECT_TRUE(std::isfinite(stored_energy(run.model(), run.state()).kinetic)) << "method " << name_of(method);
        EXPECT_NEAR(pressure_below(run), 2e6, 2e5);
    }
}

/// Forces that a stage takes off act no more after that, whatever loads there are and on whichever blocks.
TEST(LoadChanges, LeaveNothingOfForcesThatAreTakenOff)
{
    CaseDef scene = square_pattern(4.0, 4.0);
    scene.gravity = {0.0, -9.81};
    scene.domain.fixed = {"bottom", "left"};
    scene.insitu = {.given = true, .surface = 20.0, .ratio = 1.0};
    scene.boundaries = {in_situ(side("right", BoundaryKind::stress)), in_situ(side("top", BoundaryKind::stress))};
    scene.boundaries[0].stages = {"pressed"};
    scene.loads = {{.blocks = {"b1"}, .force = {1.0, 0.0}}};
    for (const double relax_to : {0.0, 0.4})
    {
        SCOPED_TRACE(relax_to);
        scene.stages = {{.name = "pressed", .cycles = 50},
                        {.name = "loose", .cycles = 150, .relax_cycles = 100, .relax_to = relax_to},
                        {.name = "on", .cycles = 100}};
        CaseRun run(scene);
        run.advance(50);
        run.simulation.begin_stage(1);
        run.advance(150);
        if (relax_to > 0.0)
            run.simulation.begin_stage(2);
        Simulation restarted(run.model(), run.state());
        run.advance(60);
        restarted.advance(60);
        EXPECT_EQ(state_hash(run.model(), run.state()), state_hash(restarted.model(), restarted.state()))
            << "a force acts that no state tells of";
        EXPECT_LT(ledger_residual(run), 1e-9);
    }
}

/// A block hangs from a roof by a tensile strength of 1.1 times its weight. All at once the weight is felt as 1.33 times as much.
TEST(LoadChanges, AWeightThatGrowsDoesNotBreakWhatBearsIt)
{
    for (const Method method : {Method::force, Method::hybrid})
        for (const std::int64_t relax_cycles : {0, 2000})
        {
            SCOPED_TRACE(relax_cycles);
            CaseDef scene = scenes::empty_scene();
            scenes::add_fixed_block(scene, "roof", scenes::rectangle({-1, 1}, {2, 2}));
            scenes::add_block(scene, "hung", scenes::rectangle({0, 0}, {1, 1}));
            scene.joints[0].tension = 1.1 * 2700.0 * 9.81;
            scene.joints[0].cohesion = 1e5;
            scene.contact.method = method;
            scene.stages = {{.name = "hang", .until_converged = true, .max_cycles = 20'000, .relax_cycles = relax_cycles}};
            CaseRun run(scene);
            const std::vector<StageResult> stages = run_stages(run.simulation, {});
            const double stretch = 2700.0 * 9.81 / scene.joints[0].normal_stiffness;
            if (relax_cycles > 0)
            {
                EXPECT_TRUE(stages[0].at_rest);
                EXPECT_NEAR(run.displacement("hung").y(), -stretch, 1e-3 * stretch);
            }
            else
                EXPECT_LT(run.displacement("hung").y(), -0.1);
            EXPECT_LT(ledger_residual(run), 1e-6);
        }
}

TEST(LoadChanges, GiveTheSameBitsOnSeveralThreadsAndInPieces)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.0, 5.0);
    scene.boundaries = {side("left", BoundaryKind::roller), side("right", BoundaryKind::roller), pressed("top", 1e6, 1e5)};
    scene.domain.fixed = {"bottom"};
    scene.boundaries.back().factor.table = {{100.0, 0.0}, {400.0, 1.0}};
    scene.stages = {{.name = "press", .until_converged = true}};
    scene.loads = {{.blocks = {"*"}, .acceleration = {1.0, 0.0}, .factor = {.ramp_cycles = Vec2(50.0, 555.0)}}};
    CaseRun one(scene);
    one.advance(900);
    for (const int threads : {2, 3})
    {
        CaseRun several(scene, threads);
        several.advance(900);
        EXPECT_EQ(several.hash(), one.hash());
    }
    CaseRun pieces(scene);
    for (int i = 0; i < 90; ++i)
        pieces.advance(10);
    EXPECT_EQ(pieces.hash(), one.hash());
    EXPECT_LT(ledger_residual(one), 1e-4) << "hybrid";
}
}  // namespace
}  // namespace hdem
