#include "core/statics/point_law.h"
#include "core/types.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
const CoulombSlip rock{.normal_stiffness = 7e9, .shear_stiffness = 5e8, .friction_coefficient = 0.6, .cohesion = 1e4};
constexpr double start_shear = 800.0;

PointPlace at(double stretch, double way)
{
    return {.length = 0.5, .stretch = stretch, .way = way, .is_closed = stretch > 0.0};
}

/// Tangent without trust against central differences of the law, to 1e-6 of the elastic stiffness.
void expect_derivatives(double stretch, double way, PointStatus status)
{
    const PointReaction here = react(rock, at(stretch, way), start_shear);
    ASSERT_EQ(here.status, status);
    const PointTangent t = tangent(rock, 0.5, here, true, 0.0);
    const double h = 1e-9;
    const auto normal = [&](double u, double s) { return react(rock, at(u, s), start_shear).normal; };
    const auto shear = [&](double u, double s) { return react(rock, at(u, s), start_shear).shear; };
    EXPECT_NEAR(t.normal, (normal(stretch + h, way) - normal(stretch - h, way)) / (2.0 * h), 3.5e3);
    EXPECT_NEAR(t.shear, -(shear(stretch, way + h) - shear(stretch, way - h)) / (2.0 * h), 2.5e2);
    EXPECT_NEAR(t.coupling, (shear(stretch + h, way) - shear(stretch - h, way)) / (2.0 * h), 2.1e3);
}

TEST(PointLaw, TangentIsTheDerivativeOfTheForces)
{
    expect_derivatives(2e-6, 1e-6, PointStatus::stick);
    expect_derivatives(2e-6, 1e-3, PointStatus::slip);
    expect_derivatives(2e-6, -1e-3, PointStatus::slip);
    expect_derivatives(-2e-6, 1e-6, PointStatus::open);   // cohesion still holds it along the joint,
    expect_derivatives(-2e-6, -1e-3, PointStatus::open);  // until that is used up
}

TEST(PointLaw, ShearForceGrowsWithTheWayOfTheWholeIncrement)
{
    EXPECT_DOUBLE_EQ(react(rock, at(2e-6, 3e-6), start_shear).shear, start_shear - 5e8 * 0.5 * 3e-6);
    const double strength = 0.6 * 7e9 * 0.5 * 2e-6 + 1e4 * 0.5;
    EXPECT_DOUBLE_EQ(react(rock, at(2e-6, 1e-3), start_shear).shear, -strength);
    EXPECT_DOUBLE_EQ(react(rock, at(2e-6, -1e-3), start_shear).shear, strength);
}

TEST(PointLaw, AnOpenPointKeepsItsCohesionUntilItIsParted)
{
    EXPECT_DOUBLE_EQ(react(rock, at(-1e-6, -1e-3), start_shear).shear, 1e4 * 0.5);
    PointPlace parted = at(-1e-6, -1e-3);
    parted.bears = false;
    EXPECT_EQ(react(rock, parted, start_shear).shear, 0.0);
    EXPECT_EQ(tangent(rock, 0.5, react(rock, parted, start_shear), false, 0.1).shear, 0.1 * 5e8 * 0.5);
}

TEST(PointLaw, AFrozenStrengthDoesNotFollowTheNormalForce)
{
    EXPECT_EQ(react(rock, at(2e-6, 1e-3), start_shear, 300.0).shear, -300.0);
    EXPECT_EQ(react(rock, at(4e-6, 1e-3), start_shear, 300.0).shear, -300.0);
}

TEST(PointLaw, TrustStandsInForTheStiffnessThatIsMissing)
{
    const PointTangent slip = tangent(rock, 0.5, react(rock, at(2e-6, 1e-3), start_shear), true, 0.25);
    EXPECT_EQ(slip.shear, 0.25 * 5e8 * 0.5);
    const PointTangent open = tangent(rock, 0.5, react(rock, at(-2e-6, -1e-3), start_shear), true, 0.25);
    EXPECT_EQ(open.normal, 0.25 * 7e9 * 0.5);
    EXPECT_EQ(open.shear, 0.25 * 5e8 * 0.5);
}
}  // namespace
}  // namespace hdem
