#include "core/geometry/tangent.h"
#include "core/types.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hdem
{
/// The nearest doubles to sums of rational numbers with 400 bits.
TEST(Tangent, IsCorrectlyRounded)
{
    EXPECT_EQ(tangent(0.0), 0.0);
    EXPECT_EQ(tangent(radians(15.0)), 0x1.126145e9ecd56p-2);
    EXPECT_EQ(tangent(radians(20.0)), 0x1.74b49cf3902d4p-2);
    EXPECT_EQ(tangent(radians(30.0)), 0x1.279a74590331cp-1);
    EXPECT_EQ(tangent(radians(35.0)), 0x1.66819a3a0bf7ap-1);
    EXPECT_EQ(tangent(radians(45.0)), 0x1.fffffffffffffp-1) << "radians(45) is below pi / 4";
    EXPECT_EQ(tangent(radians(60.0)), 0x1.bb67ae8584ca8p+0);
    EXPECT_EQ(tangent(radians(72.0)), 0x1.89f188bdcd7adp+1) << "glibc 2.36 gives the next one";
    EXPECT_EQ(tangent(radians(85.0)), 0x1.6dc2fd0bfdbe5p+3);
    EXPECT_EQ(tangent(radians(89.9)), 0x1.1e7a85f79a037p+9);
}

TEST(Tangent, IsThatOfTheLibraryToItsLastBit)
{
    for (int i = 1; i < 9000; ++i)
    {
        const double x = radians(0.01 * i);
        EXPECT_NEAR(tangent(x) / std::tan(x), 1.0, 2.0 * std::numeric_limits<double>::epsilon()) << 0.01 * i << " degrees";
    }
}
}  // namespace hdem
