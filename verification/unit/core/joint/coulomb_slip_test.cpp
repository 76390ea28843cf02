#include "core/joint/coulomb_slip.h"
#include "core/types.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace hdem
{
namespace
{
TEST(ShearStrength, IsNormalForceTimesTangentPlusCohesionTimesLength)
{
    // [Lee2025] sect. 4.1: 26 487 N on 1 m, 30 degrees, 10 kPa.
    const CoulombSlip joint{.friction_coefficient = std::tan(radians(30.0)), .cohesion = 1e4};
    EXPECT_NEAR(shear_strength(joint, 26487.0, 1.0), 25292.3, 0.05);  // the paper prints one decimal
    // Two points of half the length and force carry the same together.
    EXPECT_DOUBLE_EQ(2.0 * shear_strength(joint, 13243.5, 0.5), shear_strength(joint, 26487.0, 1.0));
}

TEST(ShearStrength, IsCohesionAloneWithoutNormalForce)
{
    const CoulombSlip joint{.friction_coefficient = 0.5, .cohesion = 2e3};
    EXPECT_DOUBLE_EQ(shear_strength(joint, 0.0, 0.25), 500.0);
}

RC_GTEST_PROP(SlipLimit, KeepsTheSignAndNeverExceedsTheStrength, (int trial, int limit))
{
    const double strength = std::abs(static_cast<double>(limit));
    const double force = slip_limited<double>(trial, strength);
    RC_ASSERT(std::abs(force) <= strength);
    RC_ASSERT(force * trial >= 0.0);
    RC_ASSERT(std::abs(static_cast<double>(trial)) > strength || force == static_cast<double>(trial));
}
}  // namespace
}  // namespace hdem
