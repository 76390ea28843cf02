#include "core/joint/continuously_yielding.h"
#include "verification/unit/core/joint/law_point.h"

namespace hdem
{
namespace
{
JointNumbers numbers(double a = 1e9, double e = 0.0)
{
    return ContinuouslyYielding::numbers({.shear_stiffness = a,
                                          .shear_exponent = e,
                                          .greatest_stiffness = 1e11,
                                          .friction = 30.0,
                                          .first_friction = 50.0,
                                          .roughness = 0.5e-3},
                                         PowerLaw::numbers(1e7, 0.5, 1e12));
}

TEST(ContinuouslyYielding, ReachesAPeakAndFalls)
{
    LawPoint<ContinuouslyYielding, PowerLaw> p(numbers(), 1e6);
    double peak = 0.0, at = 0.0;
    const double to[3] = {1e-3, 5e-3, 20e-3}, tau[3] = {0.617209e6, 0.578321e6, 0.577350e6};
    for (int k = 0; k < 3; ++k)
    {
        const int steps = 2000;
        const double start = p.u;
        for (int j = 1; j <= steps; ++j)
        {
            p.go(start + (to[k] - start) * j / steps, 1, 1e6);
            if (p.now.shear > peak)
                peak = p.now.shear, at = p.u;
        }
        EXPECT_NEAR(p.now.shear, tau[k], 1e-5 * tau[k]) << to[k];
    }
    EXPECT_NEAR(peak, 0.670104e6, 1e-5 * 0.670104e6);
    EXPECT_NEAR(at, 1.497e-3, 3e-6);
    EXPECT_GT(p.now.opening, 0.0);
}

TEST(ContinuouslyYielding, IsAlmostAsGoodInLargeSteps)
{
    LawPoint<ContinuouslyYielding, PowerLaw> fine(numbers(), 1e6), coarse(numbers(), 1e6);
    fine.go(3e-3, 3000, 1e6);
    coarse.go(3e-3, 300, 1e6);
    EXPECT_NEAR(coarse.now.shear, fine.now.shear, 1e-3 * fine.now.shear);
}

TEST(ContinuouslyYielding, StiffnessFollowsTheStressAndIsWholeAfterReversal)
{
    LawPoint<ContinuouslyYielding, PowerLaw> p(numbers(1e6, 0.5), 4e6);
    EXPECT_NEAR(1.0 / p.now.shear_compliance, 1e6 * 2e3, 1e-3);
    p.go(10e-3, 2000, 4e6);
    const double before = p.now.shear;
    p.go(10e-3 - 1e-6, 1, 4e6);
    EXPECT_NEAR((before - p.now.shear) / 1e-6, 1.0 / p.now.shear_compliance, 2e-3 / p.now.shear_compliance);
}

TEST(ContinuouslyYielding, ReloadsWithRestingShareOfAtMostThreeQuarters)
{
    LawPoint<ContinuouslyYielding, PowerLaw> p(numbers(), 1e6);
    p.go(10e-3, 2000, 1e6);
    p.go(10e-3 - 2e-5, 100, 1e6);
    const double before = p.now.shear, most = p.now.strength;
    EXPECT_GT(before / most, 0.9);
    p.go(p.u + 1e-8, 1, 1e6);
    EXPECT_NEAR((p.now.shear - before) / 1e-8, 1e9 * (1.0 - before / most) / 0.25, 1e9 * 2e-3);
}

TEST(ContinuouslyYielding, EnergyBalancesOverTenCycles)
{
    expect_energy_balance<ContinuouslyYielding, PowerLaw>(numbers(), 1e6, 5e9, 5000);
    expect_energy_balance<ContinuouslyYielding, PowerLaw>(numbers(1e6, 0.5), 1e6, 5e9, 5000);
}

TEST(ContinuouslyYielding, FourLanesHaveTheBitsOfOne)
{
    expect_same_bits<ContinuouslyYielding, PowerLaw>({numbers(), numbers(1e6, 0.5), numbers(2e9), numbers(1e5, 0.6)}, 2e-4);
    expect_open_point_rests<ContinuouslyYielding, PowerLaw>(numbers(), 1e6);
}
}  // namespace
}  // namespace hdem
