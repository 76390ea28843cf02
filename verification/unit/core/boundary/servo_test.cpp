#include "core/boundary/servo.h"
#include "parallel/stages.h"
#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

/// The servo's force is its target, the other sides answer by themselves.
TEST(Servo, BringsAColumnToItsTarget)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseDef scene = square_pattern(4.0, 8.0);
        scene.contact.method = method;
        scene.gravity = {0.0, -9.81};
        scene.insitu = {.given = true, .surface = 8.0, .ratio = 0.5};
        scene.boundaries = {side("left", BoundaryKind::roller), side("right", BoundaryKind::servo),
                            side("bottom", BoundaryKind::roller), side("top", BoundaryKind::servo)};
        scene.boundaries[1].target = 0.5e6;
        scene.boundaries[3].target = 2e6;
        scene.boundaries[3].max_velocity = 0.05;
        scene.boundaries[1].max_velocity = 0.05;
        CaseRun run(scene);
        EXPECT_FALSE(servos_press(run.model(), run.state()));
        run.advance(12000);
        EXPECT_NEAR(run.state().blocks.force[run.slot("top")].y, 2e6 * 4.0, 1e-3 * 8e6);
        EXPECT_NEAR(run.state().blocks.force[run.slot("right")].x, 0.5e6 * 8.0, 1e-3 * 4e6);
        EXPECT_TRUE(servos_press(run.model(), run.state()));
        EXPECT_LT(ledger_residual(run), 1e-6);
    }
}

/// Its target is the stress that is there. What a held block does not bear is not for its neighbours to bear.
TEST(Servo, HasNoForceForBlocksThatAreHeld)
{
    CaseDef scene = square_pattern(4.0, 4.0);
    scene.insitu = {.given = true, .stress = StressDef{-1e6, -1e6, 0.0}};
    scene.boundaries = {side("left", BoundaryKind::fixed), side("bottom", BoundaryKind::roller),
                        side("right", BoundaryKind::roller), side("top", BoundaryKind::servo)};
    scene.boundaries[3].target = 1e6;
    scene.boundaries[3].max_velocity = 0.01;
    for (const Method method : {Method::force, Method::hybrid})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        EXPECT_TRUE(servos_press(run.model(), run.state()));
        run.advance(1000);
        for (Index b = 0; b < run.model().blocks(); ++b)
            EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-12) << run.model().name[b];
    }
}

TEST(Servo, IsNoFasterThanItMay)
{
    EXPECT_EQ(servo_velocity({.normal = 0.0, .stiffness = 0.0}, 1e6, 0.01, 1e-4), 0.01);
    EXPECT_EQ(servo_velocity({.normal = 0.0, .stiffness = 1e9}, 1e6, 0.01, 1e-4), 0.01);
    EXPECT_EQ(servo_velocity({.normal = 9e6, .stiffness = 1e9}, 1e6, 0.01, 1e-4), -0.01);
    EXPECT_NEAR(servo_velocity({.normal = 1e6, .stiffness = 1e9}, 1e6 + 100.0, 0.01, 1e-4), 0.05 * 100.0 / 1e5, 1e-15);
}

/// A stage that seeks rest ends when the wall presses with its target, and keeps the step while the wall moves.
TEST(Servo, EndsAStageAtItsTarget)
{
    CaseDef scene = square_pattern(4.0, 4.0);
    scene.boundaries = {side("left", BoundaryKind::roller), side("bottom", BoundaryKind::roller), side("top", BoundaryKind::servo)};
    scene.boundaries[2].target = 1e5;
    scene.boundaries[2].max_velocity = 2e-4;  // below the speed at which blocks count as at rest
    scene.stages = {{.name = "press", .until_converged = true, .max_cycles = 200000}};
    scene.convergence.unbalanced_force_ratio = 1e9;
    scene.convergence.block_unbalanced_ratio = 1e9;
    CaseRun run(scene);
    EXPECT_FALSE(resolve_rules(run.model(), run.state()).step.varies);
    const std::vector<StageResult> stages = run_stages(run.simulation, {});
    EXPECT_TRUE(stages[0].at_rest);
    EXPECT_NEAR(run.state().blocks.force[run.slot("top")].y, 4e5, 1.1e-3 * 4e5);
}
}  // namespace
}  // namespace hdem
