#include "core/joint/coulomb_residual.h"
#include "verification/unit/core/joint/law_point.h"

#include <algorithm>

namespace hdem
{
namespace
{
using Point = LawPoint<CoulombResidual, Linear>;

CoulombInput bedding()
{
    return {.shear_stiffness = 1e9,
            .friction_angle = 30.0,
            .residual_friction = 25.0,
            .cohesion = 1e5,
            .dilation_angle = 10.0,
            .dilation_limit = 5e-3};
}
JointNumbers numbers(const CoulombInput& in)
{
    return CoulombResidual::numbers(in, Linear::numbers(1e10));
}

TEST(CoulombResidual, PeakDropAndOpeningUnderConstantStress)
{
    Point p(numbers(bedding()), 1e6);
    const double peak = 1e5 + 1e6 * std::tan(radians(30.0)), rest = 1e6 * std::tan(radians(25.0));
    EXPECT_NEAR(peak, 677350.0, 0.5);
    p.go(peak / 1e9 * (1 - 2e-7), 100, 1e6);
    EXPECT_EQ(p.memory.broken, 0.0);
    EXPECT_NEAR(p.now.shear, peak, 1e-6 * peak);
    EXPECT_NEAR(p.now.strength, peak, 1e-9 * peak);
    p.go(peak / 1e9 * (1 + 2e-7), 1, 1e6);
    EXPECT_EQ(p.memory.broken, 1.0);
    EXPECT_NEAR(p.now.shear, rest, 1e-6 * rest);
    p.go(1e-2, 1000, 1e6);
    EXPECT_NEAR(p.now.shear, 466308.0, 0.5);
    EXPECT_NEAR(p.now.shear, rest, 1e-6 * rest);
    EXPECT_NEAR(p.now.opening, 0.881635e-3, 1e-6 * 0.881635e-3);
}

/// At a fixed displacement; with dilation the stress would have to change by a jump.
TEST(CoulombResidual, TheDropFreesTheDifferenceOfTheSpringsEnergies)
{
    CoulombInput in = bedding();
    in.dilation_angle = 0.0;
    Point p(numbers(in), 1e6);
    p.go(1e-3, 100, 1e6);
    const double peak = 1e5 + 1e6 * std::tan(radians(30.0)), rest = 1e6 * std::tan(radians(25.0));
    EXPECT_NEAR(p.freed, 120.680, 1e-5 * 120.680);
    EXPECT_NEAR(p.freed, (peak * peak - rest * rest) / 2e9, 1e-9 * p.freed);
}

TEST(CoulombResidual, DilatesAgainstANormalStiffness)
{
    Point p(numbers(bedding()), 1e6);
    const double from = p.closure;
    p.go(3e-3, 1000, 1e6, 5e9, from);
    EXPECT_NEAR(p.memory.slip, 1.988652e-3, 1e-6 * 1.988652e-3);
    EXPECT_NEAR(p.now.normal, 2.168843e6, 1e-6 * 2.168843e6);
    EXPECT_NEAR(p.now.shear, 1.011348e6, 1e-6 * 1.011348e6);
    p.go(1e-2, 1000, 1e6, 5e9, from);
    EXPECT_NEAR(p.now.normal, 3.938783e6, 1e-6 * 3.938783e6);
    EXPECT_NEAR(p.now.shear, 1.836685e6, 1e-6 * 1.836685e6);
}

/// The answer at a fixed closure does not depend on the size of the steps: one to beyond the limit, one back through zero.
TEST(CoulombResidual, ReturnIsExactForAnyStep)
{
    Point fine(numbers(bedding()), 1e6), coarse(numbers(bedding()), 1e6);
    const double c = fine.closure;
    fine.step(1e-3, c);  // breaks
    coarse.step(1e-3, c);
    for (const double to : {12e-3, -3e-3, -14e-3, 2e-3})
    {
        const double start = fine.u;
        for (int k = 0; k < 1000; ++k)
            fine.step((to - start) / 1000, c);
        coarse.step(to - coarse.u, c);
        EXPECT_NEAR(coarse.now.shear, fine.now.shear, 1e-9 * std::abs(fine.now.shear)) << to;
        EXPECT_NEAR(coarse.now.normal, fine.now.normal, 1e-9 * fine.now.normal) << to;
        EXPECT_NEAR(std::abs(coarse.now.shear), coarse.now.strength, 1e-9 * coarse.now.strength) << to;
        EXPECT_NEAR(coarse.memory.slip, fine.memory.slip, 1e-12);
    }
}

TEST(CoulombResidual, HoldsTensionUntilItBreaks)
{
    CoulombInput in = bedding();
    in.tension = 5e4;
    in.residual_tension = 1e4;
    Point p(numbers(in), 1e6);
    p.step(0.0, -4.9e4 / 1e10);
    EXPECT_NEAR(p.now.normal, -4.9e4, 1e-6);
    EXPECT_EQ(p.memory.broken, 0.0);
    p.step(0.0, -5.1e4 / 1e10);
    EXPECT_EQ(p.memory.broken, 1.0);
    EXPECT_DOUBLE_EQ(p.now.normal, -1e4);
    // K V^2 / 2 less what is left: T_r |V| - T_r^2 / 2K.
    EXPECT_NEAR(p.now.freed, (0.5 * 5.1e4 * 5.1e4 - 1e4 * 5.1e4 + 0.5 * 1e8) / 1e10, 1e-12);
    p.step(0.0, -0.5e4 / 1e10);
    EXPECT_NEAR(p.now.normal, -0.5e4, 1e-6);

    in.residual_tension = 0.0;
    Point q(numbers(in), 1e6);
    q.step(0.0, -5.1e4 / 1e10);
    EXPECT_EQ(q.now.normal, 0.0);
    EXPECT_NEAR(q.now.freed, 0.5 * 5.1e4 * 5.1e4 / 1e10, 1e-12);
    q.step(0.0, 1e-6);
    EXPECT_NEAR(q.now.normal, 1e4, 1e-6);  // closes where it opened
}

TEST(CoulombResidual, ANewContactHasResidualValuesAndDoesNotDilate)
{
    Point p(numbers(bedding()), 1e6);
    p.memory.broken = 1.0;
    p.go(5e-3, 100, 1e6);
    EXPECT_NEAR(p.now.shear, 1e6 * std::tan(radians(25.0)), 1.0);
    EXPECT_EQ(p.now.opening, 0.0);
    EXPECT_EQ(p.freed, 0.0);
}

/// K_N tan phi tan psi > K_S: the strength falls faster than the shear spring unloads. Slip takes the shear stress to 0 at most.
TEST(CoulombResidual, SnapsBackNoFartherThanTheShearSpringReaches)
{
    CoulombInput in = bedding();
    in.shear_stiffness = 5e8;
    Point p(numbers(in), 1e6);
    p.step(20e-3, p.closure);
    const double c = -0.8e-3;  // held open by 0.88 mm of dilation
    p.step(0.0, c);
    EXPECT_GT(p.now.normal, 0.0);
    double tau = p.now.shear;
    EXPECT_GT(tau, 0.0);
    for (int k = 0; k < 6000; ++k)
    {
        p.step(-4e-6, c);
        EXPECT_LE(std::abs(p.now.shear), p.now.strength * (1 + 1e-12));
        EXPECT_GE(p.now.shear * p.now.slid, 0.0);
        EXPECT_LE(std::abs(p.now.slid), (std::abs(tau) + 5e8 * 4e-6) / 5e8 * (1 + 1e-12));
        tau = p.now.shear;
    }
    EXPECT_EQ(p.now.normal, 0.0);  // its opening is given back
    EXPECT_EQ(p.now.shear, 0.0);
}

TEST(CoulombResidual, EnergyBalancesOverTenCycles)
{
    CoulombInput in = bedding();
    in.dilation_limit = 3e-3;
    expect_energy_balance<CoulombResidual, Linear>(numbers(in), 1e6, 5e9, 2000);
    in.shear_stiffness = 5e9;
    expect_energy_balance<CoulombResidual, Hyperbolic>(CoulombResidual::numbers(in, Hyperbolic::numbers(1e10, 5e-4)), 1e6, 1e9,
                                                       20000);
}

TEST(CoulombResidual, FourLanesHaveTheBitsOfOne)
{
    CoulombInput a = bedding(), b = bedding(), c = bedding();
    b.tension = 1e5;
    b.residual_tension = 2e4;
    c.dilation_limit = 1e-3;
    expect_same_bits<CoulombResidual, Linear>({numbers(a), numbers(b), numbers(c), numbers(a)}, 2e-4);
    expect_open_point_rests<CoulombResidual, Linear>(numbers(a), 1e6);
}
}  // namespace
}  // namespace hdem
