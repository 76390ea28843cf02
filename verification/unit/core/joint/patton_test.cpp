#include "core/joint/patton.h"
#include "verification/unit/core/joint/law_point.h"

namespace hdem
{
namespace
{
JointNumbers numbers(double stiffness = 1e9, double limit = no_limit)
{
    return Patton::numbers({.shear_stiffness = stiffness,
                            .friction = 30.0,
                            .roughness = 15.0,
                            .residual_friction = 35.0,
                            .cohesion = 1e6,
                            .dilation_limit = limit},
                           Linear::numbers(1e9));
}

TEST(Patton, HasTwoBranches)
{
    const JointNumbers n = numbers();
    EXPECT_NEAR(n[Patton::change_stress], 3.335641e6, 0.5);
    EXPECT_NEAR(n[Patton::change_stress], 1e6 / (1.0 - std::tan(radians(35.0))), 1e-9 * 3.3e6);
    LawPoint<Patton, Linear> low(n, 1e6), high(n, 5e6);
    low.go(2e-3, 200, 1e6);
    EXPECT_NEAR(low.now.shear, 1e6, 1e-9 * 1e6);
    EXPECT_NEAR(low.now.opening, std::tan(radians(15.0)) * low.memory.slip, 1e-12);
    high.go(6e-3, 200, 5e6);
    EXPECT_NEAR(high.now.shear, 1e6 + 5e6 * std::tan(radians(35.0)), 1e-9 * 4.5e6);
    EXPECT_NEAR(high.now.shear, 4.501038e6, 0.5);
    EXPECT_EQ(high.now.opening, 0.0);
}

TEST(Patton, ReturnIsExactForAnyStepThroughTheChangeOfBranches)
{
    LawPoint<Patton, Linear> fine(numbers(), 1e6), coarse(numbers(), 1e6);
    const double c = fine.closure;
    for (const double to : {40e-3, 2e-3, -3e-3, -30e-3, 5e-3})
    {
        const double start = fine.u;
        for (int k = 0; k < 2000; ++k)
            fine.step((to - start) / 2000, c);
        coarse.step(to - coarse.u, c);
        EXPECT_NEAR(coarse.now.shear, fine.now.shear, 1e-9 * std::abs(fine.now.shear)) << to;
        EXPECT_NEAR(coarse.now.normal, fine.now.normal, 1e-9 * fine.now.normal) << to;
        EXPECT_NEAR(std::abs(coarse.now.shear), coarse.now.strength, 1e-9 * coarse.now.strength) << to;
    }
    EXPECT_GT(fine.heat, 0.0);
}

/// An opening gained below sigma_T is given back from a stress above it.
TEST(Patton, ReturnIsExactOnTheWayBackThroughTheChangeOfBranches)
{
    LawPoint<Patton, Linear> fine(numbers(), 1e6), coarse(numbers(), 1e6);
    fine.go(10e-3, 2000, 1e6);
    coarse.go(10e-3, 2000, 1e6);
    const double c = fine.closure + 3e-3;
    fine.step(0.0, c);
    coarse.step(0.0, c);
    EXPECT_GT(fine.now.normal, 3.4e6);
    for (int k = 0; k < 4000; ++k)
        fine.step(-14e-3 / 4000, c);
    coarse.step(-14e-3, c);
    EXPECT_LT(fine.now.normal, 3.2e6);
    EXPECT_NEAR(coarse.now.shear, fine.now.shear, 1e-9 * std::abs(fine.now.shear));
    EXPECT_NEAR(coarse.now.normal, fine.now.normal, 1e-9 * fine.now.normal);
}

TEST(Patton, EnergyBalancesOverTenCycles)
{
    expect_energy_balance<Patton, Linear>(numbers(), 1e6, 5e8, 2000);
    expect_energy_balance<Patton, Linear>(numbers(1e10, 2e-3), 3e6, 1e9, 2000);
}

TEST(Patton, FourLanesHaveTheBitsOfOne)
{
    expect_same_bits<Patton, Linear>({numbers(), numbers(1e10, 2e-3), numbers(1e9, 1e-3), numbers()}, 2.5e-3);
    expect_open_point_rests<Patton, Linear>(numbers(1e10), 1e6);
}
}  // namespace
}  // namespace hdem
