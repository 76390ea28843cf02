#include "core/joint/saeb_amadei.h"
#include "verification/unit/core/joint/law_point.h"

namespace hdem
{
namespace
{
JointNumbers numbers(double stiffness = 1e9, double share = 1.0)
{
    return SaebAmadei::numbers({.shear_stiffness = stiffness,
                                .rock_strength = 50e6,
                                .friction = 30.0,
                                .roughness = 15.0,
                                .rock_cohesion = 5e6,
                                .rock_friction = 40.0,
                                .residual_slip = 8e-3,
                                .residual_share = share},
                               Hyperbolic::numbers(1e10, 0.3e-3));
}

TEST(SaebAmadei, StrengthAndOpeningUnderConstantStress)
{
    const double stress[4] = {0.5e6, 1e6, 5e6, 1e7}, tau[4] = {0.563974e6, 1.107315e6, 4.922717e6, 9.058295e6};
    const double opening[4] = {1.244097e-3, 1.160739e-3, 0.691507e-3, 0.317991e-3};
    for (int k = 0; k < 4; ++k)
    {
        LawPoint<SaebAmadei, Hyperbolic> p(numbers(), stress[k]);
        p.go(5e-3 + tau[k] / 1e9, 20000, stress[k]);  // 5 mm of slip
        EXPECT_NEAR(p.now.normal, stress[k], 1e-9 * stress[k]);
        EXPECT_NEAR(p.now.shear, tau[k], 1e-6 * tau[k]);
        EXPECT_NEAR(p.memory.slip, 5e-3, 2e-6 * 5e-3);
        EXPECT_NEAR(-p.closure, opening[k], 1e-6 * 1.3e-3);
    }
}

TEST(SaebAmadei, AllAsperitiesAreShearedOffAboveTheStrengthOfTheRock)
{
    const JointNumbers n = numbers();
    EXPECT_DOUBLE_EQ(SaebAmadei::strength(n, 60e6, 0.0).value, 5e6 + 60e6 * std::tan(radians(40.0)));
    EXPECT_EQ(SaebAmadei::slope(n, 60e6).value, 0.0);
}

TEST(SaebAmadei, FallsToItsResidualStrength)
{
    LawPoint<SaebAmadei, Hyperbolic> p(numbers(1e10, 0.6), 5e6);
    p.go(12e-3, 2000, 5e6);
    EXPECT_NEAR(p.now.shear, 4.922717e6 * (0.6 + 0.4 * 0.1), 1e-5 * 5e6);
}

TEST(SaebAmadei, RatesAreThoseOfTheValues)
{
    const JointNumbers n = numbers(1e9, 0.6);
    for (const double s : {0.5e6, 5e6, 30e6})
    {
        const double h = 1.0;
        const auto value = [&](double x) { return SaebAmadei::strength(n, x, 0.7).value; };
        EXPECT_NEAR(SaebAmadei::strength(n, s, 0.7).rate, (value(s + h) - value(s - h)) / (2 * h), 1e-6);
        EXPECT_NEAR(SaebAmadei::slope(n, s).rate, (SaebAmadei::slope(n, s + h).value - SaebAmadei::slope(n, s - h).value) / (2 * h),
                    1e-13);
    }
}

TEST(SaebAmadei, EnergyBalancesOverTenCycles)
{
    expect_energy_balance<SaebAmadei, Hyperbolic>(numbers(1e10), 1e6, 1e9, 20000);
    expect_energy_balance<SaebAmadei, Hyperbolic>(numbers(1e10, 0.6), 5e6, 1e9, 20000);
}

TEST(SaebAmadei, FourLanesHaveTheBitsOfOne)
{
    expect_same_bits<SaebAmadei, Hyperbolic>({numbers(), numbers(1e10), numbers(3e10, 0.6), numbers()}, 2e-4);
    expect_open_point_rests<SaebAmadei, Hyperbolic>(numbers(1e10), 1e6);
}
}  // namespace
}  // namespace hdem
