#include "core/contact/force_law.h"
#include "core/types.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace hdem
{
namespace
{
const CoulombSlip rock{.normal_stiffness = 7e9, .shear_stiffness = 5e8, .friction_coefficient = 0.5, .cohesion = 1e4};

TEST(SpringForce, NormalIsStiffnessTimesLengthTimesOverlap)
{
    EXPECT_DOUBLE_EQ(spring_force(rock, 0.5, 2e-6, 0.0, 1e-4, 0.0).normal, 7e9 * 0.5 * 2e-6);
    EXPECT_EQ(spring_force(rock, 0.5, -2e-6, 0.0, 1e-4, 0.0).normal, 0.0) << "a gap carries no tension";
}

TEST(SpringForce, ShearOpposesTheMotionAndAddsToWhatWasThere)
{
    const PointForce f = spring_force(rock, 0.5, 1e-4, 1e-3, 1e-4, 100.0);
    EXPECT_DOUBLE_EQ(f.shear, 100.0 - 5e8 * 0.5 * 1e-7);
    EXPECT_EQ(f.excess, 0.0);
}

TEST(SpringForce, SlipsAtTheStrengthAndCountsThePlasticPart)
{
    const double length = 0.5, overlap = 1e-6, dt = 1e-4, v = 2.0;
    const PointForce f = spring_force(rock, length, overlap, v, dt, 0.0);
    const double strength = 0.5 * 7e9 * length * overlap + 1e4 * length;
    EXPECT_DOUBLE_EQ(f.shear, -strength);
    EXPECT_DOUBLE_EQ(f.strength, strength);
    EXPECT_NEAR(-f.excess / (5e8 * length), v * dt - strength / (5e8 * length), 1e-18);  // round-off of a difference of 2e-4 m
}

/// A8 of the closed-form problems: sigma = 1 MPa, 30 degrees, 1e9 Pa/m, to and fro by 5 mm.
TEST(SpringForce, DissipatesTheClosedLoopOfCyclicShear)
{
    const CoulombSlip joint{.normal_stiffness = 1e10, .shear_stiffness = 1e9, .friction_coefficient = std::tan(radians(30.0))};
    const double overlap = 1e6 / 1e10, dt = 1e-3, step = 1e-6;
    double shear = 0.0, work = 0.0, greatest = 0.0, slip = 0.0;
    const auto move = [&](int steps, double sign)
    {
        for (int i = 0; i < steps; ++i)
        {
            const PointForce f = spring_force(joint, 1.0, overlap, sign * step / dt, dt, shear);
            work -= 0.5 * (shear + f.shear) * sign * step;
            slip += std::abs(f.excess) / joint.shear_stiffness;
            shear = f.shear;
            greatest = std::max(greatest, std::abs(shear));
        }
    };
    move(5000, 1.0);
    move(10000, -1.0);
    work = slip = 0.0;
    const double start = shear;
    move(10000, 1.0);
    move(10000, -1.0);
    EXPECT_NEAR(greatest, 577350.27, 0.01);
    EXPECT_NEAR(work, 10213.67, 1.0) << "trapezium rule: the kinks cost at most one step of 1 um at 577 kN";
    EXPECT_NEAR(slip * greatest, work, 1.0) << "in a closed loop all work goes into slip";
    EXPECT_NEAR(shear, start, 1e-6 * greatest);
}

TEST(RestOverlap, IsZeroForAPointThatClosedInTheForceRegime)
{
    EXPECT_EQ(rest_overlap(1e-5, 0.0, 0.0), 0.0);
    EXPECT_EQ(rest_overlap(-1e-5, 0.0, 0.0), 0.0);
}

/// A spring handed over from the impulse regime starts with the last force at most, and its rest length only ever shortens.
RC_GTEST_PROP(RestOverlap, GivesNoMoreForceThanTheLastOneAndOnlyShrinks, ())
{
    const double overlap = 1e-9 * *rc::gen::inRange(0, 1000000);
    const double last = 0.1 * *rc::gen::inRange(0, 1000000);
    const double stiffness = 7e9 * 0.5;
    double rest = first_rest_overlap(overlap, last, stiffness);
    RC_ASSERT(rest >= 0.0);
    RC_ASSERT(stiffness * (overlap - rest) <= last + 1e-6 * overlap * stiffness);
    RC_ASSERT(rest == 0.0 || std::abs(stiffness * (overlap - rest) - last) <= 1e-9 * stiffness * overlap);
    double now = overlap;
    for (int i = 0; i < 20; ++i)
    {
        now += 1e-9 * *rc::gen::inRange(-200000, 200000);
        const double next = rest_overlap(now, rest, 0.0);
        RC_ASSERT(next <= rest);
        RC_ASSERT(next == 0.0 || next <= now);
        rest = next;
    }
}
/// Of an impulse that stops a block which falls at v and gets g dt more in the cycle, the weight remains, m g.
TEST(RemainingForce, OfACollisionIsTheWeight)
{
    const double mass = 2700.0, g = 9.81, dt = 5e-5, any = 1e300;
    for (const double v : {1e-6, 1e-3, 1.0, 50.0})
        for (const double r : {0.0, 0.1, 1.0})
            EXPECT_NEAR(remaining_force(mass * ((1.0 + r) * v + g * dt) / dt, g * dt, r, v, any), mass * g, 1e-9 * mass * g) << v;
    EXPECT_EQ(remaining_force(mass * g, g * dt, 0.1, 0.0, any), mass * g) << "of a block at rest all of it";
    EXPECT_EQ(remaining_force(100.0, 0.0, 0.1, 0.0, any), 100.0) << "without gravity";
    EXPECT_EQ(remaining_force(100.0, 0.0, 0.1, 1.0, any), 0.0);
    EXPECT_EQ(remaining_force(1e6, g * dt, 0.1, 0.0, 300.0), 300.0) << "struck by others";
}
}  // namespace
}  // namespace hdem
