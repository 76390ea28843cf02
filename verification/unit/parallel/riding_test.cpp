#include "core/motion/loads.h"
#include "parallel/stages.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
using namespace test;

/// A slab of 1 m x 0.3 m on a base, under a gravity that is turned by 12 degrees. Its factor of safety is 1.21.
CaseDef slab_on_base(Method method)
{
    CaseDef scene = scenes::empty_scene();
    BlockDef& base = scenes::add_block(scene, "base", scenes::rectangle({-60, -2}, {60, 0}));
    base.fix_x = base.fix_y = base.fix_rotation = true;
    scenes::add_block(scene, "slab", scenes::rectangle({0, 0}, {1, 0.3}));
    scene.joints[0].normal_stiffness = 1e9;
    scene.joints[0].shear_stiffness = 3e8;
    scene.joints[0].friction_angle_deg = 14.4;
    scene.gravity_tilt_deg = -12.0;
    scene.contact.method = method;
    scene.stages = {{.name = "ride", .duration = 2.0}};
    return scene;
}

/// How far the slab has slid on its base [m].
double slip(const CaseRun& run)
{
    const BlockMotion &base = run.state().blocks.motion[run.slot("base")], &slab = run.state().blocks.motion[run.slot("slab")];
    const Vec2 there(slab.x - base.x, slab.y - base.y);
    const Vec2 drawn(0.5, 1.15);
    return std::abs(base.c * there.x() + base.s * there.y() - drawn.x());
}

/// Seen from a base that moves evenly nothing changes. Damping of the velocity itself let it slide 1.6 m in 3 s.
TEST(Riding, ASlabStaysOnABaseThatMovesEvenly)
{
    for (const Method method : {Method::force, Method::hybrid})
        for (const Vec2& velocity : {Vec2(0.0, 0.0), Vec2(0.0, -0.3), Vec2(0.3, -1.0), Vec2(-0.3, 0.5)})
        {
            CaseDef scene = slab_on_base(method);
            scene.blocks[0].velocity = scene.blocks[1].velocity = velocity;
            CaseRun run(scene);
            run_stages(run.simulation, {});
            EXPECT_LT(slip(run), 1e-4) << velocity.transpose();
        }
}

/// A table that is tilted by 12 degrees in 4 s: the slab goes down with it, at up to 3 m/s.
TEST(Riding, ASlabStaysOnATableThatTilts)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseDef scene = slab_on_base(method);
        scene.gravity_tilt_deg = 0.0;
        scene.stages[0].duration = 4.0;
        scene.blocks[0].angular_velocity = -12.0 / 4.0 * std::numbers::pi / 180.0;
        scene.blocks[1].polygon = scenes::rectangle({10, 0}, {11, 0.3});
        scene.blocks[1].angular_velocity = scene.blocks[0].angular_velocity;
        scene.blocks[1].velocity = {0.0, scene.blocks[0].angular_velocity * 10.5};
        CaseRun run(scene);
        run_stages(run.simulation, {});
        const BlockMotion &base = run.state().blocks.motion[run.slot("base")], &slab = run.state().blocks.motion[run.slot("slab")];
        EXPECT_NEAR(base.angle, -12.0 * std::numbers::pi / 180.0, 1e-3);
        const double along = base.c * (slab.x - base.x) + base.s * (slab.y - base.y);
        EXPECT_NEAR(along, 10.5, 1e-3);
    }
}

/// Two held blocks that move differently: then there is no frame, and damping opposes velocities as they are.
TEST(Riding, SupportsThatMoveDifferentlyAreNone)
{
    CaseDef scene = slab_on_base(Method::force);
    scene.blocks[0].velocity = {0.0, -0.3};
    CaseRun one(scene);
    EXPECT_EQ(support_motion(one.model(), one.state()).vy, -0.3);
    scenes::add_fixed_block(scene, "other", scenes::rectangle({0, 5}, {1, 6}));
    CaseRun two(scene);
    EXPECT_TRUE(support_motion(two.model(), two.state()).is_none());
}
}  // namespace
}  // namespace hdem
