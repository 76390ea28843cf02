#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double step = 1e-3;

/// A block in free flight without gravity, 2700 kg.
CaseDef flyer()
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
    scenes::add_block(scene, "other", scenes::rectangle({50, 0}, {51, 1}));
    scene.gravity = {0.0, 0.0};
    scene.time.step = step;
    return scene;
}

/// Cycles after which the block has moved under a load.
int loaded_cycles(const Interval& interval)
{
    CaseDef scene = flyer();
    scene.loads = {{.blocks = {"block"}, .acceleration = {1.0, 0.0}, .interval = interval}};
    CaseRun run(scene);
    run.advance(100);
    return static_cast<int>(std::lround(run.velocity("block").x() / (1.0 * step)));
}

TEST(Loads, ActFromAndUntilTheGivenCyclesOrTimes)
{
    EXPECT_EQ(loaded_cycles({}), 100);
    EXPECT_EQ(loaded_cycles({.from_cycle = 10}), 90);
    EXPECT_EQ(loaded_cycles({.from_cycle = 10, .until_cycle = 25}), 15);
    EXPECT_EQ(loaded_cycles({.from_time = 0.01, .until_time = 0.025}), 15);
    EXPECT_EQ(loaded_cycles({.until_time = 0.0105}), 11) << "a cycle that has begun is finished";
    EXPECT_EQ(loaded_cycles({.from_cycle = 20, .until_cycle = 20}), 0);
}

TEST(Loads, ActOnTheNamedBlocksWithForceAccelerationAndMoment)
{
    CaseDef scene = flyer();
    scene.loads = {{.blocks = {"block"}, .acceleration = {1.0, 2.0}, .force = {2700.0, 0.0}, .moment = 450.0}};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_NEAR((run.velocity("block") - Vec2(0.2, 0.2)).norm(), 0.0, 1e-14);
    EXPECT_NEAR(run.motion("block").w, 0.1, 1e-14);
    EXPECT_EQ(run.velocity("other").norm(), 0.0);
}

TEST(Loads, ReachAllFreeBlocksByAStar)
{
    CaseDef scene = flyer();
    scenes::add_fixed_block(scene, "rock", scenes::rectangle({-50, 0}, {-49, 1}));
    scene.loads = {{.blocks = {"*"}, .acceleration = {1.0, 0.0}}};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_NEAR(run.velocity("block").x(), 0.1, 1e-14);
    EXPECT_NEAR(run.velocity("other").x(), 0.1, 1e-14);
    EXPECT_EQ(run.velocity("rock").norm(), 0.0);
}

TEST(PrescribedVelocity, MovesABlockThatLongAndStopsIt)
{
    CaseDef scene = scenes::block_on_ground();
    scene.time.step = step;
    scene.contact.method = Method::impulse;
    scene.blocks[0].velocity = {0.0, 0.0};
    scene.loads = {{.blocks = {"ground"}, .velocity_x = 0.5, .interval = {.from_cycle = 10, .until_cycle = 30}}};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_NEAR(run.displacement("ground").x(), 20 * 0.5 * step, 1e-14);
    EXPECT_EQ(run.velocity("ground").x(), 0.0);
    EXPECT_GT(run.displacement("block").x(), 1e-4) << "it takes the block along";
}

/// One load takes over where another ends, whichever is listed first.
TEST(PrescribedVelocity, PassesFromOneLoadToTheNextWithoutAGap)
{
    const LoadDef forth{.blocks = {"ground"}, .velocity_x = 0.5, .interval = {.until_cycle = 20}};
    const LoadDef back{.blocks = {"ground"}, .velocity_x = -0.5, .interval = {.from_cycle = 20, .until_cycle = 40}};
    for (const std::vector<LoadDef>& loads : {std::vector<LoadDef>{forth, back}, std::vector<LoadDef>{back, forth}})
    {
        CaseDef scene = scenes::block_on_ground();
        scene.time.step = step;
        scene.loads = loads;
        CaseRun run(scene);
        run.advance(40);
        EXPECT_NEAR(run.displacement("ground").x(), 0.0, 1e-15);
    }
}
}  // namespace
}  // namespace hdem
