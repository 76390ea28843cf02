#include "core/contact/regime.h"
#include "core/types.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
constexpr double mass = 2700.0;
constexpr double square_inertia = mass / 6.0;  // m (a^2 + a^2) / 12 of the unit square
constexpr BlockInertia unit_square{1.0 / mass, 1.0 / mass, 1.0 / square_inertia, 0.0};

TEST(CollisionMass, OfACentralImpactIsTheReducedMass)
{
    EXPECT_NEAR(1.0 / inverse_collision_mass(unit_square, 0.0, unit_square, 0.0, 0.0, 1.0), 0.5 * mass, 1e-9);
    EXPECT_NEAR(1.0 / inverse_collision_mass(unit_square, 0.0, {}, 0.0, 0.6, 0.8), mass, 1e-9)
        << "an immovable block is infinitely heavy";
}

TEST(CollisionMass, OfAUnitSquareHitAtItsCornerIsTwoFifthsOfItsMass)
{
    // 1/m + 0.5^2 / (m/6) = 2.5/m
    EXPECT_NEAR(1.0 / inverse_collision_mass(unit_square, 0.5, {}, 0.5, 0.0, 1.0), mass / 2.5, 1e-9);
}

TEST(CollisionMass, LeavesOutWhatIsPrescribed)
{
    const BlockInertia rail{0.0, 1.0 / mass, 0.0, 0.0};  // free in y only
    EXPECT_EQ(inverse_collision_mass(rail, 0.5, {}, 0.0, 1.0, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(inverse_collision_mass(rail, 0.5, {}, 0.0, 0.0, 1.0), 1.0 / mass);
}

/// The definition of the collision mass: an impulse J along n at the point changes the relative velocity there, along n, by J / m_c.
RC_GTEST_PROP(CollisionMass, TurnsAnImpulseIntoAChangeOfRelativeVelocity, ())
{
    const auto number = [](double low, double high) { return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1000001); };
    const BlockInertia a{1.0 / number(1, 10), 1.0 / number(1, 10), 1.0 / number(1, 10), 0.0};
    const BlockInertia b{1.0 / number(1, 10), 1.0 / number(1, 10), 1.0 / number(1, 10), 0.0};
    const Vec2 n = Vec2(std::cos(number(0, 6.3)), number(-1, 1)).normalized();
    const Vec2 arm_a(number(-2, 2), number(-2, 2)), arm_b(number(-2, 2), number(-2, 2));
    const auto velocity_of = [&](const BlockInertia& i, const Vec2& arm, double sign)
    {
        const Vec2 v(sign * i.inverse_mass_x * n.x(), sign * i.inverse_mass_y * n.y());
        const double w = sign * i.inverse_inertia * cross(arm, n);
        return Vec2(v + w * turned_left(arm));
    };
    const double change = n.dot(velocity_of(b, arm_b, 1.0) - velocity_of(a, arm_a, -1.0));
    const double inverse = inverse_collision_mass(a, cross(arm_a, n), b, cross(arm_b, n), n.x(), n.y());
    RC_ASSERT(std::abs(change - inverse) <= 1e-12 * inverse);
}

/// A mass thrown by a spring: all of K u^2 / 2 becomes m v^2 / 2.
TEST(ElasticVelocity, IsTheSpeedTheStoredEnergyGives)
{
    const double stiffness = 7e9, deflection = 3.78e-6;
    const double force = stiffness * deflection;
    const double v = std::sqrt(elastic_velocity_squared(force, stiffness, 1.0 / mass, 0.0, 5e8, 1.0 / mass));
    EXPECT_NEAR(0.5 * mass * v * v, 0.5 * stiffness * deflection * deflection, 1e-12 * force * deflection);
    // Two points share it: half the force, half the stiffness each.
    const double half = elastic_velocity_squared(0.5 * force, 0.5 * stiffness, 1.0 / mass, 0.0, 2.5e8, 1.0 / mass);
    EXPECT_DOUBLE_EQ(2.0 * half, v * v);
    // Two free masses share the energy at rest of their common centre: the relative speed belongs to the reduced mass.
    const double apart = std::sqrt(elastic_velocity_squared(force, stiffness, 2.0 / mass, 0.0, 5e8, 2.0 / mass));
    EXPECT_NEAR(2.0 * 0.5 * mass * 0.25 * apart * apart, 0.5 * force * deflection, 1e-12 * force * deflection);
}

/// [Lee2025] sect. 4.3: a 1 m block about to slide, dt = 5e-5 s, C_scale = 1.
TEST(ThresholdVelocity, OfTheSlidingBlockIsTheOneDerivedByHand)
{
    const double gravity_velocity = 5e-5 * 9.81;
    const double immovable = elastic_velocity_squared(26487.0, 7e9, 1.0 / mass, 25292.3, 5e8, 1.0 / mass);
    EXPECT_NEAR(threshold_velocity(1.0, gravity_velocity, immovable), 0.0231, 5e-5);
    const double heavy_ground = elastic_velocity_squared(26487.0, 7e9, 2.0 / mass, 25292.3, 5e8, 2.0 / mass);
    EXPECT_NEAR(threshold_velocity(1.0, gravity_velocity, heavy_ground), 0.0325, 5e-5);
    EXPECT_DOUBLE_EQ(threshold_velocity(3.0, gravity_velocity, immovable),
                     3.0 * threshold_velocity(1.0, gravity_velocity, immovable));
}

TEST(ThresholdVelocity, OfAFirstTouchIsWhatGravityGivesInOneStep)
{
    EXPECT_DOUBLE_EQ(threshold_velocity(1.0, 4.9e-4, elastic_velocity_squared(0.0, 7e9, 1.0 / mass, 0.0, 5e8, 1.0 / mass)), 4.9e-4);
}

/// Two blocks without gravity under the default method.
CaseDef weightless(const Polygon& upper)
{
    CaseDef scene = scenes::empty_scene();
    scene.gravity = {0.0, 0.0};
    scenes::add_fixed_block(scene, "base", scenes::rectangle({-4, -1}, {4, 0}));
    scenes::add_block(scene, "block", upper);
    return scene;
}

/// Pressed by 1.2 MN, pushed along by 0.9: asperities bear 1.2 tan(42 deg) = 1.08, impulses 1.2 tan(30 deg) = 0.69.
TEST(Regime, OfWhatLoadsPressWithoutGravityIsThatOfSprings)
{
    for (const double angle : {0.0, 23.0, 90.0})
    {
        CaseDef scene = weightless(scenes::rectangle({-0.6, 0}, {0.6, 0.6}));
        scene.joints[0].law = JointLaw::patton;
        scene.joints[0].asperity_angle_deg = 12.0;
        scene.joints[0].residual_friction_angle_deg = 34.0;
        scene.joints[0].cohesion = 1e6;
        scene.loads = {{.blocks = {"block"}, .force = {0.0, -1.2e6}},
                       {.blocks = {"block"}, .force = {0.9e6, 0.0}, .interval = {.from_cycle = 2000}}};
        test::CaseRun run(scenes::turned(scene, angle));
        run.advance(6000);
        const Vec2 bears = run.forces_between("base", "block");
        EXPECT_NEAR(bears.x(), 1.2e6, 10.0) << angle;
        EXPECT_NEAR(std::abs(bears.y()), 0.9e6, 10.0) << angle;
        EXPECT_LT(run.displacement("block").norm(), 5e-3) << angle;
    }
}

/// Two joints in series between a wall and fixed rock: F = K_N w d / 2.
TEST(Regime, OfWhatAWallPressesWithoutGravityIsThatOfSprings)
{
    CaseDef scene = weightless(scenes::rectangle({-1, 0}, {1, 1}));
    BlockDef& wall = scenes::add_fixed_block(scene, "wall", scenes::rectangle({-1, 1}, {1, 2}));
    wall.velocity = {0.0, -0.002};
    test::CaseRun run(scenes::moved(scene, {0.3, 0.7}));
    run.advance(4000);
    const double way = -run.displacement("wall").y();
    EXPECT_NEAR(run.forces_between("block", "wall").x(), 7e9 * 2.0 * way / 2.0, 0.02 * 7e9 * way);
    EXPECT_NEAR(run.forces_between("base", "block").x(), 7e9 * 2.0 * way / 2.0, 0.02 * 7e9 * way);
}

/// What hits freely bounces by its restitution, each time.
TEST(Regime, OfAFreeHitWithoutGravityIsThatOfImpulses)
{
    CaseDef scene = weightless(scenes::rectangle({-0.5, 0.01}, {0.5, 1.01}));
    scenes::add_fixed_block(scene, "roof", scenes::rectangle({-4, 1.03}, {4, 2}));
    scene.joints[0].restitution = 0.5;
    scene.blocks[1].velocity = {0.0, -1.0};
    test::CaseRun run(scene);
    run.advance(100);
    for (double speed = 1.0; speed > 0.1; speed *= 0.5)
    {
        const double sign = run.velocity("block").y();
        EXPECT_NEAR(std::abs(sign), speed, 1e-9);
        while (run.velocity("block").y() * sign > 0.0 && run.state().cycle < 100'000)
            run.advance();
        run.advance(10);
    }
}

/// A block that slides on asperities of 10 degrees and basic friction of 25, or on a joint of 35 that dilates by 10: a = g (sin b - cos b tan 35) / (1 + tan 10 tan 35).
TEST(Regime, OfARoughJointThatSlidesIsThatOfSprings)
{
    constexpr double degree = std::numbers::pi / 180.0, slope = 37.0 * degree;
    CaseDef scene = scenes::block_on_ground(2.0, 1.0);
    scene.gravity = {9.81 * std::sin(slope), -9.81 * std::cos(slope)};
    scene.joints[0].shear_stiffness = 2e9;
    CaseDef asperities = scene, dilates = scene;
    asperities.joints[0].law = JointLaw::patton;
    asperities.joints[0].friction_angle_deg = 25.0;
    asperities.joints[0].asperity_angle_deg = 10.0;
    asperities.joints[0].residual_friction_angle_deg = 30.0;
    asperities.joints[0].cohesion = 1e6;
    dilates.joints[0].friction_angle_deg = 35.0;
    dilates.joints[0].dilation_angle_deg = 10.0;
    for (const CaseDef& rough : {asperities, dilates})
        for (const double angle : {0.0, 23.0})
        {
            test::CaseRun run(scenes::turned(rough, angle));
            const auto speed_at = [&](double time)
            {
                while (run.state().time < time)
                    run.advance();
                return run.velocity("block").norm() * std::cos(10.0 * degree);
            };
            const double slow = speed_at(0.1);
            EXPECT_NEAR((speed_at(1.0) - slow) / 0.9, 0.3720, 0.01 * 0.3720) << angle;
        }
}
}  // namespace
}  // namespace hdem
