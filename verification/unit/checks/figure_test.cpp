#include "verification/checks/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification
{
namespace
{
Series noisy_curve(std::size_t n)
{
    Series series{.name = "curve"};
    for (std::size_t i = 0; i < n; ++i)
    {
        series.x.push_back(static_cast<double>(i));
        series.y.push_back(std::sin(0.37 * static_cast<double>(i)));
    }
    return series;
}

TEST(ThinnedCurve, KeepsItsPeaksAndEndsInOrder)
{
    Series series = noisy_curve(123457);
    series.y[60001] = 7.0;
    series.y[60002] = -7.0;
    thin(series, most_points);
    EXPECT_LE(series.x.size(), most_points);
    EXPECT_GT(series.x.size(), most_points / 2);
    EXPECT_EQ(series.x.size(), series.y.size());
    EXPECT_TRUE(std::ranges::is_sorted(series.x));
    EXPECT_EQ(series.x.front(), 0.0);
    EXPECT_EQ(series.x.back(), 123456.0);
    EXPECT_EQ(std::ranges::max(series.y), 7.0);
    EXPECT_EQ(std::ranges::min(series.y), -7.0);
}

TEST(ThinnedCurve, LeavesShortOnesAlone)
{
    for (const std::size_t n : {0u, 1u, 2u, 999u, 1000u})
    {
        Series series = noisy_curve(n);
        thin(series, most_points);
        EXPECT_EQ(series.x, noisy_curve(n).x);
        EXPECT_EQ(series.y, noisy_curve(n).y);
    }
}

TEST(ThinnedCurve, NeverHasMorePointsThanAsked)
{
    for (const std::size_t most : {4u, 5u, 17u, 1000u})
        for (std::size_t n = most + 1; n < most + 40; ++n)
        {
            Series series = noisy_curve(n);
            thin(series, most);
            EXPECT_LE(series.x.size(), most) << n << " samples";
            EXPECT_EQ(series.x.back(), static_cast<double>(n - 1));
        }
}
}  // namespace
}  // namespace hdem::verification
