/// A block that slides on springs goes as far as Newton's law says, wherever its load lies on its base.
#include "verification/unit/case_run.h"

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
using test::CaseRun;

struct Slope
{
    double height;  ///< of a block that is 1 m wide [m]
    double dip_deg;
    double friction_deg;
};

CaseDef block_on_slope(const Slope& slope, Method method)
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = method;
    scene.joints[0].shear_stiffness = 5e9;
    scene.joints[0].friction_angle_deg = slope.friction_deg;
    scenes::add_fixed_block(scene, "ground", {{-5.0, -1.0}, {5.0, -1.0}, {5.0, 0.0}, {-5.0, 0.0}});
    scenes::add_block(scene, "block", {{-0.5, 0.0}, {0.5, 0.0}, {0.5, slope.height}, {-0.5, slope.height}});
    const double dip = slope.dip_deg * std::numbers::pi / 180.0;
    scene.gravity = 9.81 * Vec2(std::sin(dip), -std::cos(dip));
    return scene;
}

/// [m/s2]
double newton(const Slope& slope)
{
    const double dip = slope.dip_deg * std::numbers::pi / 180.0, friction = slope.friction_deg * std::numbers::pi / 180.0;
    return 9.81 * (std::sin(dip) - std::cos(dip) * std::tan(friction));
}

/// Load at 0.20, 0.68, 0.69 and 0.85 of the way from the middle of the base to its edge. The second and the third hopped on their corners, and slid a tenth of the way.
TEST(SlidingBlock, GoesAsFarAsNewtonSaysWhereverItsLoadLies)
{
    constexpr std::int64_t cycles = 6000;
    for (const Slope& slope : {Slope{0.47, 30.0, 23.0}, Slope{1.6, 30.0, 23.0}, Slope{1.2, 37.0, 30.0}, Slope{2.0, 30.0, 23.0}})
        for (const Method method : {Method::force, Method::hybrid})
            for (const double turned_deg : {0.0, 37.0})
            {
                const CaseDef scene = scenes::turned(block_on_slope(slope, method), turned_deg);
                CaseRun run(turned_deg == 0.0 ? scene : scenes::mirrored(scene));
                run.advance(cycles);
                const double time = run.state().time;
                ASSERT_GT(time, 0.3);  // [s]
                // It slides while the springs of its base take the weight, for some hundredths of a second.
                EXPECT_NEAR(run.velocity("block").norm() / (newton(slope) * time), 1.0, 0.015)
                    << slope.height << " m high, " << slope.dip_deg << " degrees, by " << name_of(method) << ", turned by "
                    << turned_deg;
                EXPECT_NEAR(run.motion("block").w, 0.0, 0.01);
            }
}
/// Joints between them have no friction: each is as free along them as along its base, but goes along its base.
TEST(SlidingBlock, GoesAsFarInARow)
{
    constexpr std::int64_t cycles = 4000;
    const Slope slope{0.3, 20.0, 15.0};
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseDef scene = block_on_slope(slope, method);
        scene.blocks.pop_back();
        scene.materials.push_back({.name = "floor", .density = 2700.0});
        scene.blocks[0].material = "floor";
        scene.joints.push_back(scene.joints[0]);
        scene.joints[1].name = "base";
        scene.joints[1].materials = {"floor", "rock"};
        scene.joints[0].friction_angle_deg = 0.0;
        for (int i = -2; i < 3; ++i)
            scenes::add_block(scene, "block" + std::to_string(i), {{i - 0.5, 0.0}, {i + 0.5, 0.0}, {i + 0.5, 0.3}, {i - 0.5, 0.3}});
        CaseRun run(scene);
        run.advance(cycles);
        for (int i = -2; i < 3; ++i)
            EXPECT_NEAR(run.velocity("block" + std::to_string(i)).norm() / (newton(slope) * run.state().time), 1.0, 0.02)
                << i << " by " << name_of(method);
    }
}
}  // namespace
}  // namespace hdem
