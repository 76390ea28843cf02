#include "core/joint/plesha.h"
#include "verification/unit/core/joint/law_point.h"

namespace hdem
{
namespace
{
JointNumbers numbers(double stiffness = 1e9)
{
    return Plesha::numbers({.shear_stiffness = stiffness, .friction = 30.0, .roughness = 15.0, .wear = 2e-5}, Linear::numbers(1e9));
}

TEST(Plesha, ClimbsDescendsAndWears)
{
    LawPoint<Plesha, Linear> p(numbers(1e13), 1e6);
    const double to[3] = {10e-3, 1e-9, -10e-3};
    const double tau[3] = {0.912963e6, -0.332360e6, -0.832622e6}, alpha[3] = {12.39494, 11.61524, 9.78152};
    const double work[3] = {9538.1, 12786.6, 21377.8}, opening[3] = {2.42641e-3, 0.30011e-3, 2.18297e-3};
    for (int k = 0; k < 3; ++k)
    {
        p.go(to[k], 20000, 1e6);
        EXPECT_NEAR(p.now.shear, tau[k], 1e-4 * std::abs(tau[k])) << k;
        EXPECT_NEAR(15.0 * std::exp(-2e-5 * p.memory.state), alpha[k], 1e-4 * alpha[k]) << k;
        EXPECT_NEAR(p.memory.state, work[k], 1e-4 * work[k]) << k;
        EXPECT_NEAR(p.now.opening, opening[k], 2e-4 * opening[k]) << k;
    }
}

TEST(Plesha, SlipThroughTheMiddleIsSplit)
{
    JointNumbers n = numbers();
    n[Plesha::wear] = 0.0;
    LawPoint<Plesha, Linear> fine(n, 1e6), coarse(n, 1e6);
    const double c = fine.closure;
    for (const double to : {6e-3, 4e-3, -7e-3, 5e-3})
    {
        const double start = fine.u;
        for (int k = 0; k < 2000; ++k)
            fine.step((to - start) / 2000, c);
        coarse.step(to - coarse.u, c);
        EXPECT_NEAR(coarse.now.shear, fine.now.shear, 1e-9 * std::abs(fine.now.shear)) << to;
        EXPECT_NEAR(coarse.now.normal, fine.now.normal, 1e-9 * fine.now.normal) << to;
        EXPECT_NEAR(coarse.memory.slip, fine.memory.slip, 1e-12) << to;
    }
}

TEST(Plesha, EnergyBalancesOverTenCycles)
{
    expect_energy_balance<Plesha, Linear>(numbers(), 1e6, 5e8, 5000);
}

TEST(Plesha, FourLanesHaveTheBitsOfOne)
{
    expect_same_bits<Plesha, Linear>({numbers(), numbers(3e9), numbers(1e10), numbers()}, 1e-3);
    expect_open_point_rests<Plesha, Linear>(numbers(1e10), 1e6);
}
}  // namespace
}  // namespace hdem
