#include "core/energy_ledger.h"
#include "core/motion/step_control.h"
#include "core/motion/time_step.h"
#include "verification/unit/case_run.h"

#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

/// A block 2 m over the ground in a stage that looks for rest.
CaseDef falling(double loose_distance)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", rectangle({-3, -1}, {3, 0}));
    scenes::add_block(scene, "block", rectangle({-0.5, 2.0}, {0.5, 3.0}));
    scene.time.step = 5e-5;
    scene.contact.restitution = 0.1;
    scene.convergence.loose_distance = loose_distance;
    scene.stages = {{.name = "fall", .until_converged = true, .max_cycles = 100'000}};
    return scene;
}

/// Cycles until the block is within `height` of the ground.
std::int64_t fall_to(CaseRun& run, double height)
{
    while (run.displacement("block").y() > -2.0 + height && run.state().cycle < 50'000)
        run.advance();
    return run.state().cycle;
}

double residual_share(const CaseRun& run)
{
    return std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())));
}

TEST(StepControl, LetsALooseBlockFallInFewerCyclesByTheSameClock)
{
    CaseRun slow(falling(1e3)), fast(falling(0.01));
    const double free_fall = std::sqrt(2.0 * 2.0 / 9.81);
    EXPECT_NEAR(static_cast<double>(fall_to(slow, 1e-3)), free_fall / 5e-5, 0.01 * free_fall / 5e-5);
    EXPECT_LT(static_cast<double>(fall_to(fast, 1e-3)), 0.4 * free_fall / 5e-5);
    for (const CaseRun* run : {&slow, &fast})
    {
        EXPECT_NEAR(run->state().time, free_fall, 0.001);
        EXPECT_NEAR(run->velocity("block").y(), -std::sqrt(2.0 * 9.81 * 1.999), 0.005);
    }
}

TEST(StepControl, KeepsTheLedgerWhileTheStepChanges)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseDef scene = falling(0.01);
        scene.contact.method = method;
        CaseRun run(scene);
        double longest = 0.0, worst = 0.0;
        for (int i = 0; i < 4000; ++i)
        {
            run.advance();
            longest = std::max(longest, run.state().blocks.step.next);
            worst = std::max(worst, residual_share(run));
        }
        EXPECT_GT(longest, 8.0 * 5e-5);
        EXPECT_LT(worst, method == Method::force ? 1e-9 : 1e-6);
        EXPECT_NEAR(run.displacement("block").y(), -2.0, 1e-4);
    }
}

TEST(StepControl, AddsItsStepsUpToTheTime)
{
    CaseRun run(falling(0.01));
    double sum = 0.0;
    while (run.displacement("block").y() > -1.99)
    {
        run.advance();
        sum += run.state().blocks.step.last;
        ASSERT_EQ(run.state().time, sum);
    }
    EXPECT_NEAR(run.state().time, std::sqrt(2.0 * 1.99 / 9.81), 1e-3);
}

/// A light block far above falls beside a heavy one, which alone could take a great step. It hits at a step that its own springs bear, and is not thrown.
TEST(StepControl, KnowsTheSpringsOfWhatIsAboutToTouch)
{
    for (const double size : {0.01, 0.1, 0.5})
        for (const double turn : {0.0, 0.7})
        {
            CaseDef scene = scenes::empty_scene();
            scenes::add_fixed_block(scene, "ground", rectangle({-12, -1}, {12, 0}));
            scenes::add_block(scene, "great", rectangle({-11, 0}, {-1, 10}));
            Polygon light = rectangle({-0.5 * size, -0.5 * size}, {0.5 * size, 0.5 * size});
            for (Vec2& p : light)
                p = Vec2(std::cos(turn) * p.x() - std::sin(turn) * p.y() + 1.0,
                         std::sin(turn) * p.x() + std::cos(turn) * p.y() + 3.0);
            scenes::add_block(scene, "block", light);
            scene.contact.method = Method::force;
            scene.stages = {{.name = "fall", .until_converged = true, .max_cycles = 100'000}};
            CaseRun run(scene);
            const double allowed = std::sqrt(2.0 * 9.81 * 3.0) * 1.01;
            double fastest = 0.0, worst = 0.0;
            for (int i = 0; i < (size < 0.1 ? 25'000 : 8000); ++i)
            {
                run.advance();
                fastest = std::max(fastest, run.velocity("block").norm());
                worst = std::max(worst, i % 10 == 0 ? residual_share(run) : 0.0);
            }
            EXPECT_LT(fastest, allowed) << size << ' ' << turn;
            EXPECT_LT(worst, 1e-5) << size << ' ' << turn;
            EXPECT_NEAR(run.displacement("block").y(), 0.5 * size - 3.0, size);
        }
}

/// Far from all it goes by a tenth of its margin in a cycle; what it hits is found in time.
TEST(StepControl, IsShortWhereABlockFromFarHits)
{
    for (int k = 0; k < 12; ++k)
    {
        CaseDef scene = falling(0.01);
        const double height = 15.0 + 0.37 * k;
        scene.blocks[1].polygon = rectangle({-0.5, height}, {0.5, height + 1.0});
        CaseRun run(scene);
        double longest = 0.0;
        const auto touches = [&]
        { return run.state().contacts.size() > 0 && run.state().contacts.regime[0][0] != static_cast<std::uint8_t>(Regime::open); };
        while (!touches() && run.state().cycle < 50'000)
        {
            run.advance();
            longest = std::max(longest, run.state().blocks.step.next);
        }
        ASSERT_TRUE(touches()) << height;
        EXPECT_GT(longest, 20.0 * 5e-5);
        EXPECT_LT(run.state().blocks.step.next, 2.0 / std::sqrt(7e9 / 2700.0)) << height;
        EXPECT_GT(run.displacement("block").y(), -height - 4e-3) << height;
    }
}

TEST(StepControl, IsForStagesThatLookForRestUnderTheDefaultDamping)
{
    CaseDef timed = falling(0.01), dynamic = falling(0.01), paper = falling(0.01), far = falling(3.0), loaded = falling(0.01);
    timed.stages = {{.name = "fall", .cycles = 100'000}};
    dynamic.damping.preset = DampingPreset::dynamic;
    paper.damping.preset = DampingPreset::paper;
    loaded.loads.push_back({.blocks = {"block"}, .force = {0.0, 0.0}, .interval = {.until_cycle = 20'000}});
    for (const CaseDef& scene : {timed, dynamic, paper, far, loaded})
    {
        CaseRun run(scene);
        run.advance(8000);
        EXPECT_NEAR(run.state().time, 0.4, 1e-12);
        EXPECT_NEAR(run.displacement("block").y(), -0.5 * 9.81 * 0.16, 0.01);
    }
}

/// A block slides without friction at 0.2 m/s: until it has come loose itself, after 0.25 s, the step that is given holds.
TEST(StepControl, KeepsTheGivenStepWhileStandingRockMoves)
{
    for (const double speed : {0.0, 0.2})
    {
        CaseDef scene = falling(0.05);
        scene.joints[0].friction_angle_deg = 0.0;
        scenes::add_block(scene, "rock", rectangle({1.0, 0.0}, {2.0, 1.0})).velocity = {speed, 0.0};
        CaseRun run(scene);
        double longest = 0.0;
        while (run.state().time < 0.24)
        {
            run.advance();
            longest = std::max(longest, run.state().blocks.step.next);
        }
        EXPECT_LT(run.displacement("block").y(), -0.2);
        EXPECT_EQ(longest > 5e-5, speed == 0.0) << longest;
    }
}

/// Three blocks on each other: no step is given.
CaseDef stack_at_its_own_step()
{
    CaseDef scene = scenes::stack(3);
    scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 100'000}};
    return scene;
}

TEST(StepControl, TakesAShareOfTheStableStepWhereNoneIsGiven)
{
    CaseRun run(stack_at_its_own_step());
    run.advance(100);
    const double step = run.state().blocks.step.next;
    const double limit = critical_time_step(run.model(), run.state().blocks, run.state().contacts, 2000);
    EXPECT_GT(step, 2.0 * run.model().time_step);
    EXPECT_LE(step, 0.9 * limit);
    EXPECT_GE(step, 0.9 * 0.6 * limit / 1.1);
    CaseDef half = stack_at_its_own_step();
    half.time.stable_fraction = 0.45;
    CaseRun slower(half);
    slower.advance(100);
    EXPECT_NEAR(slower.state().blocks.step.next, 0.5 * step, 1e-12);
}

/// Within a swing the energy of a great step, whose velocities belong to half a step earlier, goes up and down; from one swing to the next it must not grow.
TEST(StepControl, AddsNoEnergyAtTheLargestStep)
{
    CaseDef scene = scenes::grid(6, 8);
    scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 100'000}};
    scene.convergence.mean_speed = 1e-7;  // nothing is left out
    CaseRun run(scene);
    const double start = run.energy();
    double last = std::numeric_limits<double>::infinity();
    for (int window = 0; window < 5; ++window)  // later all of it is left out
    {
        double most = -std::numeric_limits<double>::infinity();
        for (int i = 0; i < 128; ++i)
        {
            run.advance();
            most = std::max(most, run.energy());
        }
        ASSERT_LT(most, last + 2e-3) << "J, of 61 J; cycle " << run.state().cycle;
        last = most;
    }
    EXPECT_LT(last, start - 61.0) << "pressed together by its weight";
    EXPECT_GT(run.state().blocks.step.next, 2.0 * run.model().time_step);
    EXPECT_LT(residual_share(run), 1e-8);
}

/// A spike settles beside a corner. There its contact grows from nothing to 7 mm: the step must follow, though the spike gives way by less than a hundredth of its size.
TEST(StepControl, FollowsNarrowContactsThatGrow)
{
    for (const double stiffness : {1e9, 1e11})
    {
        CaseDef scene = scenes::empty_scene();
        scenes::add_fixed_block(scene, "ground",
                                {{0.440723729556336, -0.992778573402221},
                                 {1.48566572807065, -0.864756057858143},
                                 {1.51567903829599, 0.141194309255956},
                                 {-0.661378974752696, 1.09897154396052}});
        BlockDef& spike = scenes::add_block(scene, "spike",
                                            {{1.4856878951257, -0.864776272250789},
                                             {1.75247238464494, -1.57557821432872},
                                             {2.02908317650905, -1.95121070737671},
                                             {1.8944265370759, -1.50457787219135}});
        spike.velocity = {-0.0369450917623901, 0.0336906544114028};
        spike.fix_rotation = true;
        scene.gravity = {-9.80244670376811, 0.38488780155482};
        scene.loads = {{.name = "push", .blocks = {"spike"}, .force = {-1353.70366291732, 4924.14396579003}}};
        scene.joints[0].normal_stiffness = stiffness;
        scene.joints[0].shear_stiffness = 0.5 * stiffness;
        scene.joints[0].friction_angle_deg = 50.0;
        scene.contact.method = Method::force;
        scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 30'000}};
        CaseRun run(scene);
        double fastest = 0.0;
        for (int i = 0; i < 500; ++i)
        {
            run.advance(10);
            fastest = std::max(fastest, run.velocity("spike").norm());
        }
        EXPECT_LT(fastest, 0.4) << stiffness;
        EXPECT_LT(run.velocity("spike").norm(), 1e-6) << stiffness;
        EXPECT_LT(run.displacement("spike").norm(), 0.01) << stiffness;
    }
}

TEST(NextStep, FollowsTheBoundAndGrowsSlowly)
{
    const StepRule own{.varies = true}, given{.varies = true, .keeps_given = true};
    const auto bound = [](double least) { return StepBound{.touching = least}; };
    EXPECT_DOUBLE_EQ(next_step(1.0, bound(1.5), own, 1.0, true), std::exp2(0.5));
    EXPECT_DOUBLE_EQ(next_step(1.0, bound(1.5), own, 1.0, false), 1.0) << "not in each cycle";
    EXPECT_DOUBLE_EQ(next_step(1.0, bound(50.0), own, 1.0, true), 2.0) << "twofold at once";
    EXPECT_DOUBLE_EQ(next_step(32.0, bound(4.0), own, 1.0, false), 4.0) << "shorter at once";
    EXPECT_DOUBLE_EQ(next_step(1.0, bound(0.5), own, 1.0, false), 0.5) << "below Eq. (32) where that is too long";
    EXPECT_DOUBLE_EQ(next_step(1.0, bound(0.5), given, 1.0, false), 1.0) << "a step that is given is not shortened";
    EXPECT_DOUBLE_EQ(next_step(8.0, {.touching = 8.0, .standing_moves = true}, given, 1.0, true), 1.0);
    EXPECT_DOUBLE_EQ(next_step(8.0, StepBound{}, own, 1.0, true), 1.0) << "nothing moves";
}

TEST(StepControl, BeginsAnewWithEveryStage)
{
    CaseDef scene = falling(0.01);
    scene.stages.push_back({.name = "on", .cycles = 10});
    CaseRun run(scene);
    run.advance(1100);
    ASSERT_GT(run.state().blocks.step.next, 5e-5);
    run.simulation.begin_stage(1);
    EXPECT_EQ(run.state().blocks.step.next, 5e-5);
}
}  // namespace
}  // namespace hdem
