#include "core/motion/damping.h"
#include "core/stage/rules.h"
#include "core/types.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hdem
{
namespace
{
/// What the table of [Lee2025] sect. 3.3 says, row by row.
TEST(ConditionalDamping, FollowsTheContactsAndThePreset)
{
    const DampingDef def{.local = 0.8, .global_damping_ratio = 0.05, .average_frequency = 100.0};
    const auto rule = [&](DampingPreset preset) { return resolve_rules({.preset = preset, .damping = def}).damping; };
    struct Row
    {
        std::uint32_t contacts;
        float mobilised;
        DampingPreset preset;
        double local, global;
    };
    const auto paper = DampingPreset::paper, dynamic = DampingPreset::dynamic, automatic = DampingPreset::automatic;
    for (const Row& row : std::initializer_list<Row>{
             {0, 0.0, paper, 0.0, 0.0},
             {0, 0.0, automatic, 0.0, 0.0},
             {contact_force, 0.0, paper, 0.8, 0.0},
             {contact_force, 0.0, automatic, 0.8, 0.0},
             {contact_force, 0.25F, automatic, 0.8, 0.0},
             {contact_force, 0.25F, paper, 0.8, 0.0},
             {contact_force, -1.0F, paper, 0.8, 0.0},
             {contact_force, -1.0F, automatic, 0.0, 0.0},
             {contact_force, 0.0, dynamic, 0.0, 0.0},
             {contact_force, 1.0F, paper, 0.8, 0.0},
             {contact_force, 1.0F, automatic, 0.8, 0.0},
             {contact_force, 1.0F, dynamic, 0.0, 0.0},
             {contact_impulse, 0.0, paper, 0.0, 10.0},
             {contact_impulse, 0.0, automatic, 0.0, 10.0},
             {contact_impulse, 0.0, dynamic, 0.0, 10.0},
             {contact_impulse | contact_force, 0.5F, paper, 0.0, 10.0},
             {contact_impulse | contact_force, 1.0F, automatic, 0.0, 10.0},
         })
    {
        const BlockDamping damping = conditional_damping(Acting{.mobilised = row.mobilised,
                                                                .springs = (row.contacts & contact_force) != 0,
                                                                .impulses = (row.contacts & contact_impulse) != 0},
                                                         rule(row.preset));
        EXPECT_DOUBLE_EQ(damping.local, row.local) << "contacts " << row.contacts << ", preset " << static_cast<int>(row.preset);
        EXPECT_DOUBLE_EQ(damping.global, row.global) << "contacts " << row.contacts << ", preset " << static_cast<int>(row.preset);
    }
}

TEST(ConditionalDamping, LeavesTurningAloneAsAJointIsMobilised)
{
    const DampingRule along_joint{.local = 0.8, .form = LocalDamping::along_joint}, by_axis{.local = 0.8};
    EXPECT_NEAR(conditional_damping(Acting{.mobilised = 0.25, .springs = true}, along_joint).local_rotation, 0.6, 1e-15);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 1.0, .springs = true}, along_joint).local_rotation, 0.0);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 1.0, .springs = true}, by_axis).local_rotation, 0.8);
}

/// Half a swing of a block that slides loses what local damping takes, and tipping is free.
TEST(ConditionalDamping, OfABlockThatSlidesBrakesRotationsOnly)
{
    const DampingRule along_joint{.local = 0.8, .form = LocalDamping::along_joint}, by_axis{.local = 0.8};
    EXPECT_NEAR(conditional_damping(Acting{.mobilised = 1.0, .springs = true}, along_joint).braking, 8.0, 1e-12);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 0.9, .springs = true}, along_joint).braking, 0.0);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 1.0, .springs = true, .impulses = true}, along_joint).braking, 0.0);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 1.0, .springs = true}, by_axis).braking, 0.0);

    EXPECT_NEAR(conditional_damping(Acting{.mobilised = 1.0, .springs = true}, along_joint).local_across, 0.48, 1e-15);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 0.9, .springs = true}, along_joint).local_across, 0.8);

    const BlockInertia inertia{.inverse_mass_x = 1.0, .inverse_mass_y = 1.0, .inverse_inertia = 1.0};
    const BlockDamping damping{
        .local = 0.8, .local_across = 0.48, .braking = 4.0, .slides = true, .form = LocalDamping::along_joint};
    const auto damped = [&](double moment, double w, double dt)
    { return damp_rotation(Acting{.moment = moment}, inertia, w, 1.0, dt, damping); };
    for (const double sense : {1.0, -1.0})
    {
        EXPECT_DOUBLE_EQ(damped(-10.0 * sense, 2.0 * sense, 0.01), -50.0 * sense) << "brakes";
        EXPECT_DOUBLE_EQ(damped(10.0 * sense, 2.0 * sense, 0.01), 10.0 * sense) << "tips";
        EXPECT_DOUBLE_EQ(damped(-10.0 * sense, 2.0 * sense, 0.1), -20.0 * sense) << "no more than half of 2 rad/s goes in a cycle";
    }
    EXPECT_DOUBLE_EQ(damped(-10.0, 0.0, 0.01), -10.0) << "what stands still is not held";
    EXPECT_NEAR(damp_translation(Acting{.y = 10.0}, inertia, 0.0, 1.0, 0.01, damping).y, 5.2, 1e-12) << "across";
    EXPECT_EQ(damp_rotation(Acting{.moment = -10.0}, BlockInertia{}, 2.0, 1.0, 0.01, damping), -10.0) << "cannot turn";
}

/// A block that slides along (0.6, 0.8) at the limit moves freely along the joint, and is damped across it.
TEST(LocalDamping, AlongAJointIsLimitedByItsReserve)
{
    const BlockInertia inertia{.inverse_mass_x = 1.0, .inverse_mass_y = 1.0, .inverse_inertia = 1.0};
    const BlockDamping damping{.local = 0.8, .form = LocalDamping::along_joint};
    const double t_x = 0.6, t_y = 0.8;
    const auto damped = [&](double reserve)
    {
        const Acting force{.x = 10.0 * t_x - 5.0 * t_y, .y = 10.0 * t_y + 5.0 * t_x, .reserve = reserve, .t_x = t_x, .t_y = t_y};
        // 2 m/s along, 1 m/s across
        const DampedForce<double> f = damp_translation(force, inertia, 2.0 * t_x - 1.0 * t_y, 2.0 * t_y + 1.0 * t_x, 1.0, damping);
        return Vec2(t_x * f.x + t_y * f.y, t_x * f.y - t_y * f.x);
    };
    EXPECT_NEAR(damped(0.0).x(), 10.0, 1e-12);
    EXPECT_NEAR(damped(3.0).x(), 7.0, 1e-12);
    EXPECT_NEAR(damped(100.0).x(), 2.0, 1e-12);
    for (const double reserve : {0.0, 3.0, 100.0})
        EXPECT_NEAR(damped(reserve).y(), 1.0, 1e-12);
}

/// Else a block on a joint at its strength swings on its normal springs for ever.
TEST(LocalDamping, OfSlowRotationsActsWhateverFrictionHasLeft)
{
    const BlockInertia inertia{.inverse_mass_x = 1.0, .inverse_mass_y = 1.0, .inverse_inertia = 1.0};
    const BlockDamping damping{.local = 0.8, .local_rotation = 0.1, .form = LocalDamping::along_joint, .settling = 0.02};
    const auto damped = [&](double w, double radius)
    { return damp_rotation(Acting{.moment = 10.0}, inertia, w, radius, 1e-3, damping); };
    EXPECT_NEAR(damped(0.005, 2.0), 2.0, 1e-12) << "rim at 0.01 m/s";
    EXPECT_NEAR(damped(0.02, 2.0), 9.0, 1e-12) << "rim at 0.04 m/s";
    EXPECT_NEAR(damped(0.015, 2.0), 6.0, 1e-12) << "half-way between";
}

/// What can move along one axis only is damped along it.
TEST(LocalDamping, LeavesAFixedComponentAlone)
{
    const BlockInertia inertia{.inverse_mass_y = 1.0};
    const Acting force{.x = 7.0, .y = 10.0, .reserve = 3.0, .t_x = 0.6, .t_y = 0.8};
    EXPECT_DOUBLE_EQ(damp_translation(force, inertia, 0.0, 1.0, 1.0, {.local = 0.8, .form = LocalDamping::along_joint}).y, 7.0);
}

RC_GTEST_PROP(LocalDamping, TakesPowerAndLeavesABlockAtRestAlone, (int f, int v))
{
    const double force = f, velocity = v;
    const double damped = locally_damped(force, velocity, 0.8);
    RC_ASSERT((damped - force) * velocity <= 0.0);
    RC_ASSERT(std::abs(damped - force) <= 0.8 * std::abs(force) * (1.0 + 1e-15));
    RC_ASSERT(v != 0 || damped == force);
    RC_ASSERT(f != 0 || damped == 0.0);
}

TEST(LocalDamping, SlowsAndStrengthensByItsShare)
{
    EXPECT_DOUBLE_EQ(locally_damped(10.0, 1.0, 0.8), 2.0) << "speeding up";
    EXPECT_DOUBLE_EQ(locally_damped(10.0, -1.0, 0.8), 18.0) << "braking";
    EXPECT_DOUBLE_EQ(locally_damped(-10.0, 1.0, 0.8), -18.0);
}

RC_GTEST_PROP(LocalDamping, NeverTurnsAMotionRound, (int f, int v))
{
    const double force = f, velocity = v, inverse_mass = 0.5, dt = 0.1, alpha = 0.8;
    const double drag = force - stopped_by_damping(force, velocity, inverse_mass, dt, alpha);
    const double free = velocity + force * inverse_mass * dt, left = free - drag * inverse_mass * dt;
    const double rounding = 1e-14 * (std::abs(velocity) + std::abs(force));
    RC_ASSERT(std::abs(drag) <= alpha * std::abs(force) + rounding);
    RC_ASSERT(free * left >= 0.0 || std::abs(left) <= rounding);
    RC_ASSERT(std::abs(left) <= std::abs(free) + rounding);
    RC_ASSERT(std::abs(std::abs(drag) - alpha * std::abs(force)) <= rounding || std::abs(left) <= rounding);
    RC_ASSERT(stopped_by_damping(force, velocity, 0.0, dt, alpha) == force);
}

/// Energy left of a block on a spring after 100 steps of `share` of 2 / omega, the greatest of some starts.
template <typename Damped>
double energy_left(double share, const Damped& damped)
{
    double greatest = 0.0;
    for (double phase = 0.0; phase < 6.0; phase += 0.1)
    {
        const double dt = 2.0 * share;
        double x = std::cos(phase), v = std::sin(phase);
        for (int i = 0; i < 100; ++i)
        {
            v += damped(-x, v, dt) * dt;
            x += v * dt;
        }
        greatest = std::max(greatest, x * x + v * v);
    }
    return greatest;
}

/// What the velocity half a step ago opposes brakes with 1.8 times the spring, and swings on from 1 / sqrt(1.8) of the stable step.
TEST(LocalDamping, IsStableToTheLimitOfTheSpringsByTheNewVelocity)
{
    const auto by_last = [](double f, double v, double) { return locally_damped(f, v, 0.8); };
    const auto by_new = [](double f, double v, double dt) { return stopped_by_damping(f, v, 1.0, dt, 0.8); };
    EXPECT_LT(energy_left(0.5, by_last), 1e-6);
    EXPECT_GT(energy_left(0.76, by_last), 1e2);
    for (const double share : {0.1, 0.5, 0.7, 0.76, 0.8, 0.9, 0.95})
        EXPECT_LT(energy_left(share, by_new), 1e-3) << share;
}

TEST(LocalDamping, StopsABlockAndNoMore)
{
    const BlockInertia inertia{.inverse_mass_x = 1.0, .inverse_mass_y = 1.0, .inverse_inertia = 1.0};
    const BlockDamping damping{.local = 0.8, .local_rotation = 0.8, .form = LocalDamping::along_joint};
    const auto braked = [&](double velocity)
    { return damp_translation(Acting{.x = -1.0, .reserve = 9.0}, inertia, velocity, 0.0, 1.0, damping).x; };
    EXPECT_NEAR(braked(1.5), -1.5, 1e-15) << "it stops";
    EXPECT_NEAR(braked(3.0), -1.8, 1e-15);
    EXPECT_NEAR(damp_rotation(Acting{.moment = -1.0}, inertia, 1.5, 1.0, 1.0, damping), -1.5, 1e-15);
}

/// The same law in every orientation.
RC_GTEST_PROP(LocalDamping, DoesNotKnowTheAxes, (short f_t, short f_m, short v_t, short v_m, short turn))
{
    const BlockInertia inertia{.inverse_mass_x = 0.5, .inverse_mass_y = 0.5, .inverse_inertia = 1.0};
    const auto damped = [&](double angle)
    {
        const double c = std::cos(angle), s = std::sin(angle);
        const Acting force{.x = c * f_t - s * f_m, .y = s * f_t + c * f_m, .reserve = 3.0, .t_x = c, .t_y = s};
        const DampedForce<double> d = damp_translation(force, inertia, c * v_t - s * v_m, s * v_t + c * v_m, 0.1,
                                                       {.local = 0.8, .form = LocalDamping::along_joint});
        return Vec2(c * d.x + s * d.y, c * d.y - s * d.x);
    };
    const double size = std::abs(f_t) + std::abs(f_m) + 20.0 * (std::abs(v_t) + std::abs(v_m));
    RC_ASSERT((damped(0.1 * turn) - damped(0.0)).norm() <= 1e-13 * size);
}

/// A block of 2 m by 1 m by springs on a slope of 37 degrees, on a joint that opens by 10 degrees as it slips.
CaseDef on_dilatant_slope(double friction_angle_deg)
{
    constexpr double slope = 37.0 * std::numbers::pi / 180.0;
    CaseDef scene = scenes::block_on_ground(2.0, 1.0);
    scene.contact.method = Method::force;
    scene.gravity = {9.81 * std::sin(slope), -9.81 * std::cos(slope)};
    scene.joints[0].friction_angle_deg = friction_angle_deg;
    scene.joints[0].shear_stiffness = 2e9;
    scene.joints[0].dilation_angle_deg = 10.0;
    return scene;
}

/// a = g (sin b - cos b tan phi) / (1 + tan psi tan phi) = 0.372 m/s2
TEST(Damping, LeavesABlockFreeThatClimbsAsItSlides)
{
    for (const double angle : {0.0, 23.0, 90.0, 200.0})
    {
        test::CaseRun run(scenes::turned(on_dilatant_slope(35.0), angle));
        const auto to = [&](double time)
        {
            while (run.state().time < time)
                run.advance();
            return std::pair(run.state().time, run.velocity("block").norm());
        };
        const auto [begin, slow] = to(0.03);
        const auto [end, fast] = to(0.1);
        const double along = (fast - slow) / (end - begin) * std::cos(10.0 * std::numbers::pi / 180.0);
        EXPECT_NEAR(along, 0.3720, 0.01 * 0.3720) << angle;
    }
}

/// From 0.1 m/s on the joint opens by more than its closure in a cycle.
TEST(Damping, LeavesABlockFreeThatClimbsFast)
{
    for (const double angle : {0.0, 23.0})
    {
        CaseDef scene = on_dilatant_slope(35.0);
        scene.time.step = 1e-4;
        test::CaseRun run(scenes::turned(scene, angle));
        run.advance(1000);
        const double slow = run.velocity("block").norm();
        run.advance(9000);
        const double along = (run.velocity("block").norm() - slow) / 0.9 * std::cos(10.0 * std::numbers::pi / 180.0);
        EXPECT_NEAR(along, 0.3720, 0.005 * 0.3720) << angle;
        EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-9);
    }
}

TEST(Damping, LetsABlockRestBelowTheStrengthOfADilatantJoint)
{
    for (const double angle : {0.0, 23.0, 90.0, 200.0})
    {
        test::CaseRun run(scenes::turned(on_dilatant_slope(40.0), angle));
        run.advance(20'000);
        EXPECT_LT(run.velocity("block").norm(), 1e-9) << angle;
        EXPECT_LT(run.displacement("block").norm(), 1e-3) << angle;
    }
}
}  // namespace
}  // namespace hdem
