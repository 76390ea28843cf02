#include "core/rock/section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
TEST(SectionTrace, IsTheApparentDipAndTheSpacingInTheSection)
{
    const std::optional<SectionTrace> first = trace_in_section({60.0, 130.0, 90.0});
    ASSERT_TRUE(first);
    EXPECT_NEAR(first->dip_deg, -52.995501, 5e-6);
    EXPECT_NEAR(1.5 * first->stretch, 1.805633, 5e-7);
    const std::optional<SectionTrace> second = trace_in_section({35.0, 45.0, 90.0});
    EXPECT_NEAR(second->dip_deg, -26.3410, 5e-5);
    EXPECT_NEAR(2.0 * second->stretch, 2.188041, 5e-7);
}

/// Two points of the plane that lie in the section, and the distance of the next plane there.
TEST(SectionTrace, LiesInThePlane)
{
    for (double dip = 5.0; dip < 90.0; dip += 17.0)
        for (double direction = -350.0; direction < 360.0; direction += 37.0)
            for (double section = 0.0; section < 360.0; section += 41.0)
            {
                const std::optional<SectionTrace> seen = trace_in_section({dip, direction, section});
                ASSERT_TRUE(seen);
                const double d = dip * std::numbers::pi / 180.0, a = direction * std::numbers::pi / 180.0;
                const double z = section * std::numbers::pi / 180.0, t = seen->dip_deg * std::numbers::pi / 180.0;
                // East, north, up.
                const double along[3] = {std::cos(t) * std::sin(z), std::cos(t) * std::cos(z), std::sin(t)};
                const double across[3] = {-std::sin(t) * std::sin(z), -std::sin(t) * std::cos(z), std::cos(t)};
                const double normal[3] = {std::sin(d) * std::sin(a), std::sin(d) * std::cos(a), std::cos(d)};
                double on = 0.0, off = 0.0;
                for (int k = 0; k < 3; ++k)
                {
                    on += along[k] * normal[k];
                    off += across[k] * normal[k];
                }
                EXPECT_NEAR(on, 0.0, 1e-12);
                EXPECT_NEAR(std::abs(off) * seen->stretch, 1.0, 1e-12) << "one spacing on, the next plane";
            }
}

TEST(SectionTrace, OfPlanesThatStandOnIt)
{
    EXPECT_EQ(trace_in_section({90.0, 90.0, 90.0})->dip_deg, 90.0);
    EXPECT_EQ(trace_in_section({0.0, 12.0, 90.0})->dip_deg, 0.0);
    EXPECT_FALSE(trace_in_section({90.0, 0.0, 90.0})) << "parallel to the section";
}
}  // namespace
}  // namespace hdem
