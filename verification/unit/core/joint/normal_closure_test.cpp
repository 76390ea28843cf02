#include "core/joint/normal_closure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hdem
{
namespace
{
/// Tangent and energy against differences and sums of the stress; the inverse against the curve.
template <typename Curve>
void expect_consistent(const JointNumbers& n, double greatest)
{
    const int steps = 200000;
    double sum = 0.0, last = 0.0;
    const double h = greatest / steps;
    for (int k = 1; k <= steps; ++k)
    {
        const BasicCurvePoint<double> p = Curve::at(n, h * k);
        sum += 0.5 * (last + p.stress) * h;
        last = p.stress;
        if (k % 10000 != 0)
            continue;
        EXPECT_NEAR(p.energy, sum, 1e-5 * p.energy);
        const double slope = (Curve::at(n, h * k * (1 + 1e-6)).stress - Curve::at(n, h * k * (1 - 1e-6)).stress) / (2e-6 * h * k);
        EXPECT_NEAR(p.stiffness, slope, 1e-6 * slope) << k;
        EXPECT_NEAR(Curve::closure_under(n, p.stress), h * k, 1e-12 * greatest);
    }
}

TEST(NormalClosure, TangentEnergyAndInverseFitTheStress)
{
    expect_consistent<Linear>(Linear::numbers(1e10), 1e-3);
    expect_consistent<Hyperbolic>(Hyperbolic::numbers(1.7e10, 1e-4), 0.94e-4);
    expect_consistent<PowerLaw>(PowerLaw::numbers(1e6, 0.5, 1e12), 1e-3);
}

TEST(NormalClosure, GoesOnStraightBeyondTheCap)
{
    const JointNumbers n = Hyperbolic::numbers(1e10, 1e-4);
    const double k = Hyperbolic::at(n, 0.95e-4).stiffness;
    EXPECT_NEAR(k, 400.0 * 1e10, 1e-3 * k * 1e-6);
    const BasicCurvePoint<double> cap = Hyperbolic::at(n, 0.95e-4), beyond = Hyperbolic::at(n, 1.5e-4);
    EXPECT_NEAR(beyond.stress, cap.stress + k * 0.55e-4, 1e-9 * beyond.stress);
    EXPECT_NEAR(beyond.energy, cap.energy + 0.5 * (cap.stress + beyond.stress) * 0.55e-4, 1e-9 * beyond.energy);
    EXPECT_NEAR(Hyperbolic::closure_under(n, beyond.stress), 1.5e-4, 1e-16);

    const JointNumbers p = PowerLaw::numbers(1e6, 0.5, 1e10);  // reached at 100 MPa and 20 mm
    EXPECT_NEAR(p[curve_cap_stress], 1e8, 1e-4);
    EXPECT_NEAR(p[curve_cap], 2e-2, 1e-14);
    EXPECT_NEAR(PowerLaw::at(p, 3e-2).stress, 1e8 + 1e10 * 1e-2, 1.0);
    // b V^2 up to the cap: a third of stress times closure; then a trapezium.
    EXPECT_NEAR(PowerLaw::at(p, 3e-2).energy, 1e8 * 2e-2 / 3 + 0.5 * (1e8 + 2e8) * 1e-2, 1e-8 * 2e6);
    EXPECT_NEAR(PowerLaw::closure_under(p, 2e8), 3e-2, 1e-12);
}

TEST(NormalClosure, EnergyKeepsItsDigitsAtSmallClosures)
{
    const JointNumbers n = Hyperbolic::numbers(1e10, 1e-4);
    const double x = 1e-6;  // share of V_m; -x - ln(1 - x) = x^2 / 2 + x^3 / 3 + ...
    EXPECT_NEAR(Hyperbolic::at(n, x * 1e-4).energy, 1e10 * 1e-8 * (x * x / 2 + x * x * x / 3 + x * x * x * x / 4),
                1e-13 * 1e2 * x * x / 2);
}

TEST(NormalClosure, IsStraightUnderTension)
{
    EXPECT_EQ(Linear::at(Linear::numbers(1e10), -1e-6).stress, -1e4);
    EXPECT_DOUBLE_EQ(Hyperbolic::at(Hyperbolic::numbers(1e10, 1e-4), -1e-6).stress, -1e4);
    EXPECT_EQ(PowerLaw::at(PowerLaw::numbers(1e6, 0.5, 1e12), -1e-6).stress, 0.0);
    EXPECT_EQ(PowerLaw::closure_under(PowerLaw::numbers(1e6, 0.5, 1e12), 0.0), 0.0);
}

TEST(NormalClosure, HasTheSameBitsInFourLanes)
{
    const JointNumbers h = Hyperbolic::numbers(1.7e10, 1e-4), p = PowerLaw::numbers(1e6, 0.4, 1e11);
    const auto spread = [](const JointNumbers& one)
    {
        BasicJointNumbers<Pack> four;
        for (int i = 0; i < joint_numbers; ++i)
            four[i] = one[i];
        return four;
    };
    const Pack v(Pack::V{-1e-5, 0.0, 3e-5, 2e-3});
    const BasicCurvePoint<Pack> a = Hyperbolic::at(spread(h), v), b = PowerLaw::at(spread(p), v);
    for (int i = 0; i < lanes; ++i)
    {
        EXPECT_EQ(a.stress.v[i], Hyperbolic::at(h, v.v[i]).stress);
        EXPECT_EQ(a.energy.v[i], Hyperbolic::at(h, v.v[i]).energy);
        EXPECT_EQ(b.stress.v[i], PowerLaw::at(p, v.v[i]).stress);
        EXPECT_EQ(b.stiffness.v[i], PowerLaw::at(p, v.v[i]).stiffness);
    }
}
}  // namespace
}  // namespace hdem
