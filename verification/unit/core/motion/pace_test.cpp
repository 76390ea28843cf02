#include "core/energy_ledger.h"
#include "core/motion/pace.h"
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

/// A block 2 m over the ground, or 2 m up a slope of 30 degrees, in a stage that looks for rest.
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

TEST(Pace, OfAFallingBlockIsThatOfTheClockWhenItHits)
{
    CaseRun slow(falling(1e3)), fast(falling(0.01));
    const double free_fall = std::sqrt(2.0 * 2.0 / 9.81) / 5e-5;
    EXPECT_NEAR(static_cast<double>(fall_to(slow, 1e-3)), free_fall, 0.01 * free_fall);
    EXPECT_LT(static_cast<double>(fall_to(fast, 1e-3)), 0.4 * free_fall);
    const Index block = fast.slot("block");
    EXPECT_EQ(fast.state().blocks.pace[block], 1.0);
    EXPECT_NEAR(fast.velocity("block").y(), -std::sqrt(2.0 * 9.81 * 1.999), 0.02);
    EXPECT_NEAR(fast.velocity("block").y(), slow.velocity("block").y(), 0.02);
}

TEST(Pace, KeepsTheEnergyInEveryChange)
{
    CaseRun run(falling(0.01));
    double greatest = 1.0;
    const Index block = run.slot("block");
    for (int i = 0; i < 4000; ++i)
    {
        run.advance();
        const Blocks& blocks = run.state().blocks;
        greatest = std::max(greatest, blocks.pace[block]);
        EXPECT_TRUE(is_pace(blocks.pace[block]));
        EXPECT_TRUE(are_paces(run.state().pace));
        EXPECT_EQ(blocks.inertia[block].inverse_mass_x,
                  blocks.pace[block] * blocks.pace[block] * run.model().full_inertia[block].inverse_mass_x);
        const double turning = blocks.motion[block].w / blocks.pace[block];
        EXPECT_DOUBLE_EQ(kinetic_energy(run.model(), blocks, block),
                         0.5 * run.model().mass[block] * blocks.velocity(block).squaredNorm() +
                             0.5 * run.model().inertia[block] * turning * turning);
    }
    EXPECT_GT(greatest, 8.0);
    EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-4);
    EXPECT_NEAR(run.displacement("block").y(), -2.0, 1e-2);
}

/// Where it comes to rest does not depend on it.
TEST(Pace, EndsWhereTheClockDoes)
{
    CaseRun slow(falling(1e3)), fast(falling(0.01));
    slow.advance(30'000);
    fast.advance(10'000);
    EXPECT_NEAR(slow.displacement("block").y(), fast.displacement("block").y(), 1e-6);
    EXPECT_NEAR(slow.displacement("block").x(), fast.displacement("block").x(), 1e-6);
}

/// One that falls so far that it goes by its greatest margin in ten cycles comes out of the dark at any distance.
TEST(Pace, OfABlockFromFarIsThatOfTheClockWhenItHits)
{
    for (int k = 0; k < 12; ++k)
    {
        CaseDef scene = falling(0.01);
        const double height = 15.0 + 0.37 * k;
        scene.blocks[1].polygon = rectangle({-0.5, height}, {0.5, height + 1.0});
        CaseRun run(scene);
        double fastest = 1.0;
        const auto touches = [&]
        { return run.state().contacts.size() > 0 && run.state().contacts.regime[0][0] != static_cast<std::uint8_t>(Regime::open); };
        while (!touches() && run.state().cycle < 50'000)
        {
            run.advance();
            fastest = std::max(fastest, run.state().pace.loose);
        }
        ASSERT_TRUE(touches()) << height;
        EXPECT_GT(fastest, 50.0);
        EXPECT_EQ(run.state().blocks.pace[run.slot("block")], 1.0) << height;
        EXPECT_GT(run.displacement("block").y(), -height - 2e-3) << height;
    }
}

/// Two that fly at each other, each in the dark.
TEST(Pace, OfBlocksThatMeetInTheAirIsThatOfTheClock)
{
    for (int k = 0; k < 60; ++k)
    {
        CaseDef scene = falling(0.01);
        scene.gravity = {0.0, 0.0};
        const double way = 5.0 + 0.0075 * k;
        scene.blocks[1].polygon = rectangle({0.0, 2.0}, {1.0, 3.0});
        scene.blocks[1].velocity = {-16.0, 0.0};
        scenes::add_block(scene, "other", rectangle({-1.0 - 2.0 * way, 2.0}, {-2.0 * way, 3.0})).velocity = {16.0, 0.0};
        CaseRun run(scene);
        while (run.velocity("block").x() < -15.99 && run.state().cycle < 50'000)
            run.advance();
        EXPECT_NEAR(run.displacement("block").x(), -way, 2e-3);
        EXPECT_EQ(run.state().blocks.pace[run.slot("block")], 1.0);
        EXPECT_LT(run.state().cycle, 4'000);
    }
}

TEST(Pace, IsForBlocksThatAreLooseInAStageThatLooksForRest)
{
    CaseDef timed = falling(0.01), dynamic = falling(0.01), paper = falling(0.01), far = falling(3.0);
    timed.stages = {{.name = "fall", .cycles = 100'000}};
    dynamic.damping.preset = DampingPreset::dynamic;
    paper.damping.preset = DampingPreset::paper;
    for (const CaseDef& scene : {timed, dynamic, paper, far})
    {
        CaseRun run(scene);
        run.advance(8000);
        EXPECT_EQ(run.state().blocks.pace[run.slot("block")], 1.0);
        EXPECT_NEAR(run.displacement("block").y(), -0.5 * 9.81 * 0.16, 0.01);
    }
}

TEST(Pace, IsOneForAllLooseBlocks)
{
    CaseDef scene = falling(0.01);
    scenes::add_block(scene, "fast", rectangle({1.5, 2.0}, {2.5, 3.0})).velocity = {0.0, -2.0};
    CaseRun run(scene);
    const auto fallen = [&](const char* name) { return -run.displacement(name).y(); };
    int ahead = 0;
    while (fallen("fast") < 1.9)
    {
        run.advance();
        if (fallen("block") < 0.05)
            continue;
        const double pace = run.state().blocks.pace[run.slot("fast")];
        ASSERT_EQ(run.state().blocks.pace[run.slot("block")], pace) << "cycle " << run.state().cycle;
        ahead += pace > 1.0;
    }
    EXPECT_GT(ahead, 100);
    // What the two have fallen belongs to the same time.
    const double t = run.state().time;
    EXPECT_NEAR(fallen("block"), 0.5 * 9.81 * t * t, 0.01);
    EXPECT_NEAR(fallen("fast"), 2.0 * t + 0.5 * 9.81 * t * t, 0.02);
}

TEST(Pace, AddsUpToTheTime)
{
    CaseRun run(falling(0.01));
    double sum = 0.0;
    while (run.displacement("block").y() > -1.99)
    {
        run.advance();
        sum += run.state().pace.loose;
        ASSERT_NEAR(run.state().time, 5e-5 * sum, 1e-12);
        ASSERT_EQ(run.state().time, static_cast<double>(run.state().cycle) * 5e-5 + run.state().ahead);
    }
    EXPECT_GT(run.state().ahead, 0.0);
    EXPECT_NEAR(run.state().time, std::sqrt(2.0 * 1.99 / 9.81), 2e-3);
}

/// A block slides without friction at 0.2 m/s: until it has come loose itself, after 0.25 s, nothing falls ahead of it.
TEST(Pace, StaysWithTheRockUntilThatHasComeToRest)
{
    for (const double speed : {0.0, 0.2})
    {
        CaseDef scene = falling(0.05);
        scene.joints[0].friction_angle_deg = 0.0;
        scenes::add_block(scene, "rock", rectangle({1.0, 0.0}, {2.0, 1.0})).velocity = {speed, 0.0};
        CaseRun run(scene);
        double greatest = 1.0;
        while (run.state().time < 0.24)
        {
            run.advance();
            greatest = std::max(greatest, run.state().blocks.pace[run.slot("block")]);
        }
        EXPECT_LT(run.displacement("block").y(), -0.2);
        EXPECT_EQ(greatest > 1.0, speed == 0.0) << greatest;
    }
}

/// Three blocks on each other: no step is given.
CaseDef stack_at_its_own_step()
{
    CaseDef scene = scenes::stack(3);
    scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 100'000}};
    return scene;
}

TEST(Pace, OfTheRockIsTheStableStepOfTheCasesThatGiveNone)
{
    CaseDef own = stack_at_its_own_step(), given = own, loaded = own, driven = own, plated = own, timed = own, paper = own;
    given.time.step = CaseRun(own).model().time_step;
    loaded.loads.push_back({.blocks = {"block1"}, .force = {1.0, 0.0}});
    driven.blocks[3].fix_x = true;
    driven.loads.push_back({.blocks = {"block3"}, .velocity_x = 0.0});
    scenes::add_fixed_block(plated, "plate", rectangle({5, 5}, {6, 6})).velocity = {0.1, 0.0};
    timed.stages = {{.name = "rest", .cycles = 100'000}};
    paper.damping.preset = DampingPreset::paper;
    for (const CaseDef& scene : {given, loaded, driven, plated, timed, paper})
    {
        CaseRun run(scene);
        run.advance(600);
        EXPECT_EQ(run.state().pace.rock, 1.0);
        EXPECT_EQ(run.state().blocks.pace, std::vector<double>(run.state().blocks.pace.size(), 1.0));
        EXPECT_EQ(run.state().ahead, 0.0);
    }
    CaseRun run(own);
    run.advance(600);
    const double pace = run.state().pace.rock;
    const double limit = critical_time_step(run.model(), run.state().blocks, run.state().contacts, 2000);
    EXPECT_GT(pace, 2.0);
    EXPECT_LE(pace * run.model().time_step, 0.9 * limit);
    EXPECT_GE(pace * run.model().time_step, 0.9 * 0.6 * limit / 1.1);
    for (const char* name : {"block1", "block2", "block3"})
        EXPECT_EQ(run.state().blocks.pace[run.slot(name)], pace);
}

/// From 1, the step of Eq. (32), in steps of 9 %, eight of which are 2.
TEST(Pace, OfTheRockFollowsTheShareOfTheStableStep)
{
    const auto pace = [](double share)
    {
        CaseDef scene = stack_at_its_own_step();
        scene.time.stable_fraction = share;
        CaseRun run(scene);
        run.advance(600);
        return run.state().pace.rock;
    };
    const double usual = CaseDef{}.time.stable_fraction;
    EXPECT_NEAR(pace(usual / 2.0), pace(usual) / 2.0, 1e-12);
    EXPECT_EQ(pace(0.05), 1.0);
}

/// Within a swing the energy of a great step, whose velocities belong to half a step earlier, goes up and down; from one swing to the next it must not grow.
TEST(Pace, OfARockAtItsOwnStepAddsNoEnergy)
{
    CaseDef scene = scenes::grid(6, 8);
    scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 100'000}};
    scene.convergence.mean_speed = 1e-7;  // nothing is left out
    CaseRun run(scene);
    const double start = run.energy();
    double last = std::numeric_limits<double>::infinity();
    for (int window = 0; window < 16; ++window)
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
    EXPECT_GT(run.state().pace.rock, 2.0);
    EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-8);
    EXPECT_LT(run.simulation.equilibrium().kinetic_energy, 1e-12);
}

/// What a checkpoint may hold.
TEST(Pace, OfTheRockIsUpTo64AndThatOfLooseBlocks64TimesAsMuch)
{
    for (const Paces& paces : {Paces{1.0, 1.0}, Paces{1.0, 64.0}, Paces{64.0, 64.0}, Paces{64.0, 4096.0}})
        EXPECT_TRUE(are_paces(paces)) << paces.rock << ' ' << paces.loose;
    for (const Paces& paces : {Paces{0.5, 1.0}, Paces{65.0, 65.0}, Paces{2.0, 1.0}, Paces{2.0, 129.0}, Paces{std::nan(""), 1.0}})
        EXPECT_FALSE(are_paces(paces)) << paces.rock << ' ' << paces.loose;
}

TEST(Pace, LeavesOutWhatIsPrescribedOfABlock)
{
    CaseDef scene = falling(0.01);
    scene.blocks[1].fix_x = scene.blocks[1].fix_rotation = true;
    CaseRun run(scene);
    run.advance(1100);
    const Index block = run.slot("block");
    const BlockInertia& inertia = run.state().blocks.inertia[block];
    const double pace = run.state().blocks.pace[block];
    ASSERT_GT(pace, 1.0);
    EXPECT_EQ(inertia.inverse_mass_x, 0.0);
    EXPECT_EQ(inertia.inverse_inertia, 0.0);
    EXPECT_EQ(inertia.inverse_mass_y, pace * pace * run.model().full_inertia[block].inverse_mass_y);
}

TEST(Pace, BeginsAnewWithEveryStage)
{
    CaseDef scene = falling(0.01);
    scene.stages.push_back({.name = "on", .cycles = 10});
    CaseRun run(scene);
    run.advance(1100);
    const Index block = run.slot("block");
    ASSERT_GT(run.state().blocks.pace[block], 1.0);
    const Vec2 velocity = run.state().blocks.velocity(block);
    run.simulation.begin_stage(1);
    EXPECT_EQ(run.state().blocks.pace[block], 1.0);
    EXPECT_EQ(run.velocity("block"), velocity);
}
}  // namespace
}  // namespace hdem
