/// Joints with tension and dilation under impulses.

#include "core/energy_ledger.h"
#include "io/case_reader.h"
#include "verification/unit/core/boundary/sides.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double g = 9.81, weight = 2700.0 * g;

/// A block of 1 m below a roof.
CaseDef hung(double tension, double residual = 0.0)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "roof", scenes::rectangle({-1, 1}, {2, 2}));
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
    scene.contact.method = Method::impulse;
    scene.joints[0].cohesion = 1e6;
    scene.joints[0].tension = tension;
    scene.joints[0].residual_tension = residual;
    return scene;
}

TEST(JointImpulses, BearTensionThatIsThereFromTheStart)
{
    CaseDef scene = hung(50e3);
    scene.insitu = {.given = true, .stress = StressDef{}, .gradient = {0.0, weight, 0.0}};
    CaseRun run(scene);
    run.advance(5000);
    EXPECT_LT(run.displacement("block").norm(), 1e-12);
    EXPECT_NEAR(run.forces_between("roof", "block").x(), -weight, 1e-9 * weight);
}

TEST(JointImpulses, BearTension)
{
    for (const double angle : {0.0, 23.0, 90.0})
        for (const CaseDef& scene : {hung(50e3), hung(1.01 * weight)})
        {
            CaseRun run(scenes::mirrored(scenes::turned(scene, angle)));
            run.advance(5000);
            EXPECT_LT(run.displacement("block").norm(), 1e-9) << angle;
            EXPECT_NEAR(run.forces_between("roof", "block").x(), -weight, 1e-6 * weight) << angle;
        }
    CaseRun falls(hung(0.99 * weight));
    falls.advance(5000);
    const double time = falls.state().time;
    EXPECT_NEAR(falls.displacement("block").y(), -0.5 * g * time * time, 0.01 * g * time * time);
}

/// A slab on a slope: sweeps load one of its two points up to its strength before the other one.
TEST(JointImpulses, HoldAsLongAsAllOfTheJointDoes)
{
    struct Slope
    {
        double dip, friction, turn;
    };
    for (const Slope& slope : {Slope{25.0, 0.0, 0.0}, Slope{45.0, 20.0, 0.0}, Slope{45.0, 20.0, 61.0}})
    {
        const double b = slope.dip * std::numbers::pi / 180.0, tan_phi = std::tan(slope.friction * std::numbers::pi / 180.0);
        const auto moved = [&](double factor)
        {
            CaseDef scene = scenes::block_on_ground(2.0, 1.0);
            scene.gravity = {g * std::sin(b), -g * std::cos(b)};
            scene.contact.method = Method::impulse;
            scene.joints[0].friction_angle_deg = slope.friction;
            scene.joints[0].cohesion = factor * weight * (std::sin(b) - std::cos(b) * tan_phi);
            scene.joints[0].residual_friction_angle_deg = slope.friction;
            CaseRun run(scenes::turned(scene, slope.turn));
            run.advance(3000);
            return run.displacement("block").norm();
        };
        EXPECT_LT(moved(1.01), 1e-5) << slope.dip;
        EXPECT_GT(moved(0.99), 1e-3) << slope.dip;
    }
}

/// Below two roof blocks, of which one has hardly a share.
TEST(JointImpulses, HangOnTwoJointsAsLongAsBothTogetherHold)
{
    const auto moved = [](double tension)
    {
        CaseDef scene = scenes::empty_scene();
        scenes::add_fixed_block(scene, "left", scenes::rectangle({-1, 1}, {0.13, 2}));
        scenes::add_fixed_block(scene, "right", scenes::rectangle({0.13, 1}, {2, 2}));
        scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
        scene.contact.method = Method::impulse;
        scene.joints[0].cohesion = 1e6;
        scene.joints[0].tension = tension;
        CaseRun run(scene);
        run.advance(3000);
        return run.displacement("block").norm();
    };
    EXPECT_LT(moved(1.03 * weight), 1e-6);
    EXPECT_GT(moved(0.97 * weight), 1e-3);
}

/// With residual friction alone there is no bond, and slip leaves less friction all the same.
TEST(JointImpulses, SlideWithResidualFriction)
{
    CaseDef scene = scenes::block_on_ground(2.0, 1.0);
    const double b = 36.0 * std::numbers::pi / 180.0, residual = 25.0 * std::numbers::pi / 180.0;
    scene.gravity = {g * std::sin(b), -g * std::cos(b)};
    scene.contact.method = Method::impulse;
    scene.joints[0].friction_angle_deg = 35.0;
    scene.joints[0].residual_friction_angle_deg = 25.0;
    CaseRun run(scene);
    run.advance(3000);
    const double time = run.state().time;
    const double way = 0.5 * g * (std::sin(b) - std::cos(b) * std::tan(residual)) * time * time;
    EXPECT_NEAR(run.displacement("block").norm(), way, 0.01 * way);
}

/// Nothing moves, so that all energies are round-off; what the impulses take in each cycle is the scale.
TEST(JointImpulses, LeaveNoResidualWhereALoadHangs)
{
    CaseDef scene = hung(50e3);
    scene.gravity = {0.0, 0.0};
    scene.loads = {{.blocks = {"block"}, .acceleration = {0.0, -g}}};
    CaseRun run(scene);
    run.advance(2000);
    EXPECT_LT(test::ledger_residual(run), 1e-6);
}

/// The same where the load grows: on a block that is held along x, whichever way it is turned, and on one that hangs by shear alone.
TEST(JointImpulses, LeaveNoResidualWhereALoadGrows)
{
    const std::string text = R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 2e9
friction_angle_deg = 33.0
cohesion = 2e6
[contact]
method = "impulse"
[gravity]
vector = [0, 0]
[[block]]
name = "base"
polygon = [[-2, -1], [2, -1], [2, 0], [-2, 0]]
fixed = true
[[block]]
name = "block"
polygon = [[-0.5, 0], [0.5, 0], [0.5, 0.5], [-0.5, 0.5]]
fixed = ["rotation"]
[[load]]
blocks = ["block"]
force = [0.0, -1.3e6]
ramp_cycles = [0, 1000]
[[stage]]
cycles = 1
)";
    for (const Vec2& force : {Vec2(0.0, -1.3e6), Vec2(1.3e6, 0.0)})
        for (const bool is_held : {false, true})
            for (const double angle : {0.0, 90.0, 37.0})
            {
                CaseDef scene = read_case_text(text, "case.toml").def;
                scene.loads.front().force = force;
                scene = scenes::turned(scene, angle);
                scene.blocks.back().fix_x = is_held && force.x() == 0.0 && angle == 0.0;
                scene.blocks.back().fix_y = is_held && force.x() == 0.0 && angle == 90.0;
                CaseRun run(scene);
                double worst = 0.0;
                for (int i = 0; i < 30; ++i)
                {
                    run.advance(50);
                    worst = std::max(worst, test::ledger_residual(run));
                }
                EXPECT_LT(worst, 1e-6) << force.transpose() << " N, turned by " << angle;
            }
}

/// Pulled with 30 kN for a moment. Residual tension acts up to half of the skin.
TEST(JointImpulses, AreLeftWithResidualTensionOnceTorn)
{
    const auto moved = [](double residual)
    {
        CaseDef scene = hung(50e3, residual);
        scene.loads = {{.blocks = {"block"}, .force = {0.0, -30e3}, .interval = {.from_cycle = 100, .until_cycle = 400}}};
        CaseRun run(scene);
        run.advance(10'000);
        EXPECT_LT(test::ledger_residual(run), 1e-6);
        return run.displacement("block").norm();
    };
    EXPECT_GT(moved(0.9 * weight), 0.5);
    EXPECT_LT(moved(1.3 * weight), 0.1);
}

/// The joint opens by tan psi times its slip, up to the limit, and a block that is pushed over it keeps its speed but for friction.
TEST(JointImpulses, DilateByTheirSlip)
{
    CaseDef scene = scenes::block_on_ground(2.0, 1.0);
    scene.contact.method = Method::impulse;
    scene.joints[0].friction_angle_deg = 30.0;
    scene.joints[0].dilation_angle_deg = 10.0;
    scene.joints[0].dilation_limit = 0.02;
    scene.blocks.back().velocity = {0.5, 0.0};
    for (const double angle : {0.0, 23.0})
    {
        CaseRun run(scenes::turned(scene, angle));
        const Eigen::Rotation2D<double> back(-angle * std::numbers::pi / 180.0);
        const auto moved = [&] { return Vec2(back * run.displacement("block")); };
        while (moved().x() < 0.01 && run.state().cycle < 10'000)
            run.advance();
        const double rise = 0.5 * std::tan(std::numbers::pi / 18.0) * run.state().blocks.step.last;  // in a cycle
        EXPECT_NEAR(moved().y(), std::tan(std::numbers::pi / 18.0) * moved().x(), 2.0 * rise);
        run.advance(10'000);
        EXPECT_NEAR(moved().y(), std::tan(std::numbers::pi / 18.0) * 0.02, 1e-5);
        EXPECT_NEAR(moved().x(), 0.25 / (2.0 * g * std::tan(std::numbers::pi / 6.0)), 0.01 * 0.022);
    }
}

/// 1 mm forth and back. The block follows the joint as that closes, and keeps its weight on it.
TEST(JointImpulses, CloseOnTheWayBack)
{
    const std::string text = R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e10
friction_angle_deg = 35.0
dilation_angle_deg = 12.0
[contact]
method = "impulse"
[[block]]
name = "base"
polygon = [[-4, -1], [4, -1], [4, 0], [-4, 0]]
fixed = true
[[block]]
name = "block"
polygon = [[-0.5, 0], [0.5, 0], [0.5, 0.5], [-0.5, 0.5]]
fixed = ["x", "rotation"]
[[load]]
blocks = ["block"]
velocity_x = 0.01
until_time = 0.1
[[load]]
blocks = ["block"]
velocity_x = -0.01
from_time = 0.1
until_time = 0.2
[[stage]]
duration = 0.3
)";
    CaseRun run(read_case_text(text, "case.toml").def);
    const double base = 0.5 * weight;
    const auto advance_to = [&](double time)
    {
        while (run.state().time < time)
            run.advance();
    };
    advance_to(0.1);
    EXPECT_NEAR(run.displacement("block").y(), std::tan(12.0 * std::numbers::pi / 180.0) * 1e-3, 3e-6);
    advance_to(0.15);
    EXPECT_NEAR(run.forces_between("base", "block").x(), base, 1e-3 * base);
    advance_to(0.25);
    EXPECT_NEAR(run.displacement("block").y(), 0.0, 3e-6);
    EXPECT_LT(test::ledger_residual(run), 1e-6);
}
}  // namespace
}  // namespace hdem
