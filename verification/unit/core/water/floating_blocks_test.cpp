#include "core/water/water_motion.h"
#include "parallel/stages.h"
#include "verification/unit/core/boundary/sides.h"
#include "verification/unit/io/broken_runs.h"
#include "verification/unit/small_run.h"

#include <algorithm>
#include <numbers>

namespace hdem
{
namespace
{
using namespace test;

/// A raft of 2 m x 1 m and 300 kg/m3 in water 3 m deep: at rest its centre is at 3.2 m.
CaseDef raft(double height, double density = 300.0)
{
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].normal_stiffness = 1e8;
    scene.joints[0].shear_stiffness = 5e7;
    scene.materials.push_back({.name = "light", .density = density});
    scene.water = {.given = true, .level = 3.0};
    scenes::add_fixed_block(scene, "ground", scenes::rectangle({-4.0, -1.0}, {4.0, 0.0}));
    scenes::add_block(scene, "raft", scenes::rectangle({-1.0, height - 0.5}, {1.0, height + 0.5})).material = "light";
    return scene;
}

/// Let go at 2.7 m it rises out of the water: weight 5886 N, lift 19620 N/m up to 3.5 m, so that its energy ends at 3.5 + 1569.6 / 5886 m.
TEST(FloatingBlocks, SwingUpAndDownWithoutGrowing)
{
    CaseDef scene = raft(2.7);
    scene.stages = {{.name = "swing", .cycles = 100'000}};
    CaseRun run(scene);
    double low = 3.0, high = 3.0, high_at_first = 0.0;
    for (int i = 0; i < 5000; ++i)
    {
        run.advance(20);
        const double now = run.position("raft").y() + run.model().origin.y();
        low = std::min(low, now);
        high = std::max(high, now);
        if (i == 500)
            high_at_first = high;
    }
    EXPECT_NEAR(high_at_first, 3.5 + 1569.6 / 5886.0, 0.005);
    EXPECT_LT(high, 3.5 + 1569.6 / 5886.0 + 0.01);
    EXPECT_GT(low, 2.69);
    EXPECT_LT(ledger_residual(run), 1e-9);
}

TEST(FloatingBlocks, ComeToRestWhereTheWaterBearsThem)
{
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
        for (const double start : {2.2, 2.7, 5.0})
        {
            CaseDef scene = raft(start);
            scene.contact.method = method;
            scene.stages = {{.name = "settle", .until_converged = true, .max_cycles = 50'000}};
            hdem::Setup setup = build_model(scene);
            Simulation simulation(std::move(setup.model), std::move(setup.state));
            const std::vector<StageResult> results = run_stages(simulation, {});
            EXPECT_TRUE(results[0].at_rest) << name_of(method) << " from " << start;
            const Index block = simulation.model().find_block("raft");
            const BlockMotion& at = simulation.state().blocks.motion[block];
            EXPECT_NEAR(at.y + simulation.model().origin.y(), 3.2, 2e-3) << name_of(method) << " from " << start;
        }
}

/// Lighter by what the water gives: it falls by g (1 - 1000 / 2000), and no share of it is lost while it flies.
TEST(FloatingBlocks, SinkWithTheWeightThatIsLeft)
{
    CaseDef scene = raft(2.4, 2000.0);
    scene.stages = {{.name = "sink", .duration = 0.5}};
    CaseRun run(scene);
    while (run.state().time < 0.5)
        run.advance(1);
    EXPECT_NEAR(run.velocity("raft").y(), -0.5 * 9.81 * run.state().time, 5e-3);
}

/// Water brakes in a stage that seeks rest, from its first cycle on, whatever the damping of the stage before.
TEST(FloatingBlocks, AreBrakedFromTheStartOfAStageThatSeeksRest)
{
    CaseDef scene = raft(2.7);
    scene.damping.preset = DampingPreset::dynamic;
    scene.stages = {{.name = "swing", .cycles = 100},
                    {.name = "settle", .until_converged = true, .damping = DampingPreset::automatic}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(100);
    run.simulation.begin_stage(1);
    EXPECT_GT(run.velocity("raft").y(), 0.01);
    EXPECT_LE(run.state().water_until, run.state().cycle + 16);
}

TEST(FloatingBlocks, GoOnFromACheckpoint)
{
    const ScratchFolder folder("floating_checkpoint");
    CaseDef scene = raft(2.7);
    scene.contact.method = Method::hybrid;
    scene.stages = {{.name = "swing", .cycles = 700}, {.name = "settle", .until_converged = true, .max_cycles = 1000}};
    expect_to_go_on(scene, folder.path(), runs::run_unbroken(scene), {1, 77, 699, 703, 1100}, {1, 2});
}

/// A column that tips with its foot in water: it is not damped, as what floats, but the ground bears it.
TEST(FloatingBlocks, AreNotThoseThatTip)
{
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].friction_angle_deg = 60.0;
    scenes::add_fixed_block(scene, "ground", scenes::rectangle({-50.0, -2.0}, {50.0, 0.0}));
    scenes::add_block(scene, "column", scenes::rectangle({0.0, 0.0}, {1.0, 3.0}));
    scene = scenes::turned(scene, -30.0);
    scene.gravity = {0.0, -9.81};
    scene.water = {.given = true, .level = 0.5};
    scene.stages = {{.name = "tip", .until_converged = true}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    const Index column = run.model().find_block("column");
    int tipped = 0;
    while (run.state().time < 0.9)
    {
        run.advance(1);
        const bool tips = std::ranges::any_of(run.state().moving, [&](const MovingBlock& moving)
                                              { return moving.block == column && moving.how == FreeMotion::tips; });
        tipped += tips ? 1 : 0;
        ASSERT_FALSE(floats(column, run.state()));
    }
    EXPECT_GT(tipped, 100);
    EXPECT_NE(run.state().water[column].y, 0.0);
}

/// Forces are found for the pose in the middle of the time for which they hold.
TEST(FloatingBlocks, AreMovedOnByTheirVelocity)
{
    const BlockMotion pose = moved_on({.x = 1.0, .y = 2.0, .vx = 3.0, .vy = -1.0, .w = std::numbers::pi, .angle = 0.1}, 0.5);
    EXPECT_EQ(pose.x, 2.5);
    EXPECT_EQ(pose.y, 1.5);
    EXPECT_NEAR(pose.c, 0.0, 1e-15);
    EXPECT_NEAR(pose.s, 1.0, 1e-15);
    EXPECT_NEAR(pose.angle, 0.1 + 0.5 * std::numbers::pi, 1e-15);
}
}  // namespace
}  // namespace hdem
