#include "core/energy_ledger.h"
#include "core/motion/pace.h"
#include "verification/unit/case_run.h"

#include <cmath>

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
        EXPECT_EQ(blocks.inertia[block].inverse_mass_x,
                  run.model().full_inertia[block].inverse_mass_x * blocks.pace[block] * blocks.pace[block]);
        EXPECT_DOUBLE_EQ(kinetic_energy(run.model(), blocks, block),
                         0.5 * run.model().mass[block] * blocks.velocity(block).squaredNorm());
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
