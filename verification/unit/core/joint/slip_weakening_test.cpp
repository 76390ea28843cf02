#include "core/joint/slip_weakening.h"
#include "verification/unit/core/joint/law_point.h"

#include <numbers>

namespace hdem
{
namespace
{
constexpr double peak = 0.7, residual = 0.5, length = 2e-3;  // tan phi, tan phi_r, D [m]

JointNumbers numbers(double stiffness = 5e9, double weakening_length = length)
{
    return SlipWeakening::numbers({.shear_stiffness = stiffness,
                                   .friction = std::atan(peak) * 180.0 / std::numbers::pi,
                                   .residual_friction = std::atan(residual) * 180.0 / std::numbers::pi,
                                   .weakening_length = weakening_length},
                                  Linear::numbers(1e10));
}

TEST(SlipWeakening, StrengthFallsInProportionToSlipAndThenStays)
{
    LawPoint<SlipWeakening, Linear> point(numbers(), 1e6);
    for (const double slip : {0.0, 0.5e-3, 1e-3, 1.9e-3, 2e-3, 5e-3})
    {
        const double friction = residual + (peak - residual) * std::max(1.0 - slip / length, 0.0);
        const double target = slip + friction * 1e6 / 5e9;
        point.step(target - point.u, point.closure);
        EXPECT_NEAR(point.now.shear, friction * 1e6, 1e-9 * 1e6) << slip;
        EXPECT_NEAR(point.memory.slip, slip, 1e-12) << slip;
        EXPECT_NEAR(SlipWeakening::damage_of(point.n, point.memory), std::min(slip / length, 1.0), 1e-9) << slip;
    }
    EXPECT_EQ(point.now.opening, 0.0);
}

/// Slip to and fro counts: three ways of 0.4 mm weaken by 1.2 mm.
TEST(SlipWeakening, SlipBackWeakensToo)
{
    LawPoint<SlipWeakening, Linear> point(numbers(1e13), 1e6);
    const double c = point.closure;
    for (const double to : {0.4e-3, 0.0, 0.4e-3})
        for (int k = 0; k < 1000; ++k)
            point.step((to - point.u) / (1000 - k), c);
    EXPECT_NEAR(point.memory.state, 1.2e-3, 1e-3 * 1.2e-3);
    EXPECT_NEAR(point.now.shear / 1e6, residual + (peak - residual) * 0.4, 1e-3);
}

TEST(SlipWeakening, ReturnIsExactForAnyStepThroughTheEndOfWeakening)
{
    LawPoint<SlipWeakening, Linear> fine(numbers(), 1e6), coarse(numbers(), 1e6);
    const double c = fine.closure;
    for (const double to : {1e-3, 4e-3, -3e-3})
    {
        const double start = fine.u;
        for (int k = 0; k < 2000; ++k)
            fine.step((to - start) / 2000, c);
        coarse.step(to - coarse.u, c);
        EXPECT_NEAR(coarse.now.shear, fine.now.shear, 1e-9 * std::abs(fine.now.shear)) << to;
        EXPECT_NEAR(coarse.memory.state, fine.memory.state, 1e-12) << to;
    }
}

/// Friction falls by 2e8 Pa/m. A spring of 5e9 Pa/m follows it; one of 1e8 Pa/m snaps to the residual strength.
TEST(SlipWeakening, SnapsWhereFrictionFallsFasterThanTheSpring)
{
    LawPoint<SlipWeakening, Linear> stiff(numbers(5e9, 1e-3), 1e6), soft(numbers(1e8, 1e-3), 1e6);
    for (LawPoint<SlipWeakening, Linear>* p : {&stiff, &soft})
    {
        const double yield = peak * 1e6 / p->n[SlipWeakening::shear_stiffness];
        p->step(0.999 * yield, p->closure);
        EXPECT_EQ(p->memory.state, 0.0);
        p->step(0.011 * yield, p->closure);
    }
    EXPECT_GT(stiff.memory.state, 0.0);
    EXPECT_LT(stiff.memory.state, 2e-6);
    EXPECT_NEAR(stiff.now.shear, 1e6 * (peak - (peak - residual) * stiff.memory.state / 1e-3), 1e-3);
    EXPECT_NEAR(soft.now.shear, residual * 1e6, 1e-3);
    EXPECT_NEAR(soft.memory.state, (1.01 * peak - residual) * 1e6 / 1e8, 1e-12);
}

TEST(SlipWeakening, KeepsItsPeakWhenAsked)
{
    JointNumbers n = numbers();
    EXPECT_TRUE(SlipWeakening::loses_strength(n));
    SlipWeakening::keep_peak(n);
    SlipWeakening::weaken(n, 2.0);
    EXPECT_FALSE(SlipWeakening::loses_strength(n));
    LawPoint<SlipWeakening, Linear> point(n, 1e6);
    point.step(50e-3, point.closure);
    EXPECT_NEAR(point.now.shear, 0.5 * peak * 1e6, 1e-9 * 1e6);
    EXPECT_NEAR(SlipWeakening::peak_strength(n, 1e6), 0.5 * peak * 1e6, 1e-9 * 1e6);
}

TEST(SlipWeakening, EnergyBalancesOverTenCycles)
{
    expect_energy_balance<SlipWeakening, Linear>(numbers(), 1e6, 5e8, 2000);
    expect_energy_balance<SlipWeakening, Linear>(numbers(1e10, 5e-2), 3e6, 1e9, 2000);
}

TEST(SlipWeakening, FourLanesHaveTheBitsOfOne)
{
    expect_same_bits<SlipWeakening, Linear>({numbers(), numbers(1e10, 2e-2), numbers(1e8, 1e-3), numbers()}, 2.5e-4);
    expect_open_point_rests<SlipWeakening, Linear>(numbers(1e10), 1e6);
}
}  // namespace
}  // namespace hdem
