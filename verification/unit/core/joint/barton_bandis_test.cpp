#include "core/joint/barton_bandis.h"
#include "verification/unit/core/joint/law_point.h"

namespace hdem
{
namespace
{
BartonBandisInput rough()
{
    return {.roughness = 10.0, .wall_strength = 1e8, .residual_friction = 30.0, .length = 1.0, .normal_stress = 1e6};
}
/// With JRC and JCS taken as those of the length.
JointNumbers numbers()
{
    JointNumbers n = BartonBandis::numbers(rough(), Hyperbolic::numbers(1.749286e10, 0.08236e-3));
    n[BartonBandis::roughness] = radians(10.0) / std::log(10.0);
    n[BartonBandis::log_strength] = std::log(1e8);
    n[BartonBandis::peak_displacement] = 1.0 / 500.0 * std::pow(10.0, 0.33);
    n[BartonBandis::shear_stiffness] = BartonBandis::steepest(n, 1e6);
    return BartonBandis::with_inverses(n);
}

TEST(BartonBandis, MobilisesItsRoughness)
{
    const JointNumbers n = numbers();
    const double peak = n[BartonBandis::peak_displacement];
    EXPECT_NEAR(peak, 4.275924e-3, 1e-9);
    EXPECT_NEAR(n[BartonBandis::shear_stiffness] * peak / 1e6, 2.33, 0.01);
    LawPoint<BartonBandis, Hyperbolic> p(n, 1e6);
    const double x[7] = {0.15, 0.3, 0.6, 1.0, 2.0, 4.0, 10.0};
    const double tau[7] = {0.26795, 0.57735, 1.0, 1.19175, 1.07237, 0.96569, 0.83910};
    for (int k = 0; k < 7; ++k)
    {
        p.go(x[k] * peak, 120000, 1e6);
        EXPECT_NEAR(p.now.shear, 1e6 * tau[k], 1e-4 * 1e6 * tau[k]) << x[k];
        const double opening = k == 3 ? 0.347492e-3 : k == 5 ? 2.207835e-3 : p.now.opening;
        EXPECT_NEAR(p.now.opening, opening, 1e-4 * opening);
    }
    EXPECT_GE(p.least_heat, 0.0);
}

/// As at the start of a trial with reduced strength.
TEST(BartonBandis, SlipsOnUntilItBearsWhatItHas)
{
    JointNumbers n = numbers();
    BartonBandis::weaken(n, 1.5);
    const double peak = n[BartonBandis::peak_displacement];
    for (const double sign : {1.0, -1.0})
    {
        JointMemory m;
        BartonBandis::mobilise(n, 1e6, sign * 0.7e6, m);
        EXPECT_GT(m.state, 0.6 * peak);
        EXPECT_LT(m.state, peak);
        EXPECT_NEAR(m.slip + sign * 0.7e6 / n[BartonBandis::shear_stiffness], sign * m.state, 1e-12) << "all of it has been slid";
        EXPECT_NEAR(std::tan(BartonBandis::friction_angle(n, m.state / peak, radians(20.0))) / 1.5, 0.7, 1e-9);
    }
    JointMemory worn{.slip = 0.01, .state = 3.0 * peak};
    BartonBandis::mobilise(n, 1e6, 0.7e6, worn);
    EXPECT_EQ(worn.state, 3.0 * peak) << "behind its peak it stays where it is";
    JointMemory failing;
    BartonBandis::mobilise(n, 1e6, 2e6, failing);
    EXPECT_EQ(failing.state, peak) << "no farther than to its peak";
}

TEST(BartonBandis, ScalesWithTheBlockSize)
{
    BartonBandisInput in = rough();
    in.length = 2.0;
    const JointNumbers n = BartonBandis::numbers(in, Hyperbolic::numbers(1e10, 1e-4));
    EXPECT_NEAR(n[BartonBandis::scaled_roughness], 5.492803, 1e-6 * 5.492803);
    EXPECT_NEAR(std::exp(n[BartonBandis::log_strength]), 40.70905e6, 1e-6 * 40.70905e6);
    EXPECT_NEAR(n[BartonBandis::peak_displacement], 5.582801e-3, 1e-6 * 5.582801e-3);
    LawPoint<BartonBandis, Hyperbolic> p(n, 1e6);
    p.go(n[BartonBandis::peak_displacement], 20000, 1e6);
    EXPECT_NEAR(p.now.strength, 0.805220e6, 1e-6 * 0.805220e6);
}

TEST(BartonBandis, ClosesAsBandisSays)
{
    const BandisClosure c = bandis_closure(10.0, 1e8, 1.2e8, 3);
    EXPECT_NEAR(c.aperture, 0.28e-3, 1e-5 * 0.28e-3);
    EXPECT_NEAR(c.stiffness, 17.49286e9, 1e-5 * 17.49286e9);
    EXPECT_NEAR(c.greatest, 0.08236e-3, 0.6e-8);
    const JointNumbers n = Hyperbolic::numbers(c.stiffness, c.greatest);
    const double stress[3] = {1e6, 5e6, 1e7}, closure[3] = {0.033744e-3, 0.063935e-3, 0.071986e-3},
                 stiffness[3] = {50.21, 349.62, 1103.17};
    for (int k = 0; k < 3; ++k)
    {
        const double v = Hyperbolic::closure_under(n, stress[k]);
        EXPECT_NEAR(v, closure[k], 1e-5 * closure[k] + 0.5e-9);
        EXPECT_NEAR(Hyperbolic::at(n, v).stiffness, stiffness[k] * 1e9, 1e-5 * stiffness[k] * 1e9 + 0.5e7);
        EXPECT_NEAR(Hyperbolic::at(n, v).stress, stress[k], 1e-12 * stress[k]);
    }
    EXPECT_NEAR(Hyperbolic::at(n, Hyperbolic::closure_under(n, 1e7)).energy, 142.140, 1e-5 * 142.140);
    const BandisClosure first = bandis_closure(10.0, 1e8, 1.2e8, 1);
    const JointNumbers f = Hyperbolic::numbers(first.stiffness, first.greatest);
    EXPECT_NEAR(first.greatest, 0.17888e-3, 0.6e-8);
    EXPECT_NEAR(Hyperbolic::closure_under(f, 1e6), 0.043321e-3, 1e-9);
    EXPECT_NEAR(Hyperbolic::closure_under(f, 5e6), 0.110024e-3, 1e-9);
    EXPECT_NEAR(Hyperbolic::closure_under(f, 1e7), 0.136246e-3, 1e-9);
}

TEST(BartonBandis, GainsNoRoughnessOnReversalAndStaysOpen)
{
    LawPoint<BartonBandis, Hyperbolic> p(numbers(), 1e6);
    p.go(20e-3, 8000, 1e6);
    const double state = p.memory.state, strength = p.now.shear, opening = p.now.opening, slip = p.memory.slip;
    p.go(20e-3 - strength * p.now.shear_compliance, 4000, 1e6);
    EXPECT_EQ(p.memory.slip, slip);  // elastic
    p.go(-10e-3, 4000, 1e6);
    EXPECT_NEAR(p.now.shear, -strength, 1e-4 * strength);
    EXPECT_EQ(p.now.opening, opening);
    EXPECT_EQ(p.memory.state, state);
    p.go(-21e-3, 4000, 1e6);
    EXPECT_GT(p.memory.state, state);
    EXPECT_GT(p.now.opening, opening);
    EXPECT_LT(std::abs(p.now.shear), strength);
}

/// At constant height the normal stress grows by all that the joint opens. The opening is still the integral of tan(m i / M) d delta, and the stress that of the
/// strength at it; found here by small steps of delta.
TEST(BartonBandis, OpensAsFarBetweenStiffWalls)
{
    for (const double stiffness : {1e8, 1e9, 5e9})
        for (const int steps : {2000, 8000})
        {
            BartonBandisInput in = rough();
            in.normal_stress = 5e6;
            const JointNumbers n = BartonBandis::numbers(in, Linear::numbers(stiffness));
            const double peak = n[BartonBandis::peak_displacement], end = 3.0 * peak, closure = 1e6 / stiffness;
            LawPoint<BartonBandis, Linear> p(n, 1e6);
            double opening = 0.0, shear = 0.0;
            const int fine = 20'000;
            for (int k = 0; k < fine; ++k)
            {
                const double x = (k + 0.5) / fine * end / peak;
                const double i = BartonBandis::roughness_angle(n, stiffness * (closure + opening));
                opening += std::tan(BartonBandis::mobilised(x) * i * n[BartonBandis::per_damage]) * end / fine;
            }
            const double normal = stiffness * (closure + opening);
            shear = normal * std::tan(BartonBandis::friction_angle(n, end / peak, BartonBandis::roughness_angle(n, normal)));
            for (int k = 0; k < steps; ++k)
                p.step(end / steps, closure);
            EXPECT_NEAR(p.now.opening, opening, 1e-2 * opening) << stiffness << ", " << steps;
            EXPECT_NEAR(p.now.shear, shear, 1e-2 * shear) << stiffness << ", " << steps;
        }
}

TEST(BartonBandis, EnergyBalancesOverTenCycles)
{
    expect_energy_balance<BartonBandis, Hyperbolic>(numbers(), 1e6, 5e9, 20000);
}

TEST(BartonBandis, FourLanesHaveTheBitsOfOne)
{
    BartonBandisInput in = rough();
    in.length = 0.3;
    in.damage = 1.0;
    const JointNumbers other = BartonBandis::numbers(in, Hyperbolic::numbers(1e10, 2e-4));
    expect_same_bits<BartonBandis, Hyperbolic>({numbers(), other, numbers(), other}, 0.6e-4);
    expect_open_point_rests<BartonBandis, Hyperbolic>(numbers(), 1e6);
}
}  // namespace
}  // namespace hdem
