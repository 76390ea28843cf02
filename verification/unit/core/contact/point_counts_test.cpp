#include "core/contact/point_counts.h"

#include <gtest/gtest.h>

namespace hdem
{
TEST(PointCounts, AreThoseOfEachRegimeAtBothEnds)
{
    for (const Index contacts : {0, 1, 254, 255, 256, 511, 2000})
    {
        Contacts some;
        some.resize(contacts);
        std::array<Index, 4> expected{};
        for (Index i = 0; i < contacts; ++i)
            for (Index end = 0; end < 2; ++end)
            {
                const Index regime = i < 600 ? 3 : (i * i + end) % 4;  // 255 and more of a kind that follow each other
                some.regime[end][i] = static_cast<std::uint8_t>(regime);
                expected[regime] += 1;
            }
        expected[0] = 0;
        EXPECT_EQ(count_points(some), expected) << contacts << " contacts";
    }
}
}  // namespace hdem
