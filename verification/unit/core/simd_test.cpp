#include "core/simd.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace hdem
{
namespace
{
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::array<double, 4> a{1.5, -2.0, 0.0, 1e300};
const std::array<double, 4> b{-0.25, 3.0, 0.1, 1e10};

std::array<double, 4> values(Pack p)
{
    std::array<double, 4> out;
    p.store(out.data());
    return out;
}

/// Each lane has the very bits of the same operation on doubles.
template <typename Operation>
void expect_each_lane(const Operation& operation)
{
    const std::array<double, 4> packed = values(operation(Pack::load(a.data()), Pack::load(b.data())));
    for (int i = 0; i < lanes; ++i)
        EXPECT_EQ(packed[i], operation(a[i], b[i])) << "lane " << i;
}

TEST(Pack, DoesWhatDoublesDo)
{
    expect_each_lane([](auto x, auto y) { return x + y; });
    expect_each_lane([](auto x, auto y) { return x - y; });
    expect_each_lane([](auto x, auto y) { return x * y; });
    expect_each_lane([](auto x, auto y) { return x / y; });
    expect_each_lane([](auto x, auto y) { return max(x, y); });
    expect_each_lane([](auto x, auto y) { return min(x, y); });
    expect_each_lane([](auto x, auto) { return abs(x); });
    expect_each_lane([](auto x, auto y) { return select(x > y, x, y * x); });
}

TEST(Pack, FusesNoMultiplicationWithAnAddition)
{
    // (1 + e)² - 1 loses e² when the product is rounded; fused it would keep it.
    const double x = 1.0 + std::numeric_limits<double>::epsilon();
    const Pack result = Pack(x) * Pack(x) - Pack(1.0);
    volatile double product = x * x;
    EXPECT_EQ(values(result)[0], product - 1.0);
}

TEST(Pack, TakesTheSecondOfAPairWithANaN)
{
    EXPECT_EQ(values(max(Pack(nan), Pack(1.0)))[2], 1.0);
    EXPECT_EQ(values(min(Pack(nan), Pack(1.0)))[2], 1.0);
    EXPECT_EQ(max(nan, 1.0), 1.0);
}

TEST(Pack, SumsInTheOrderOfItsLanes)
{
    EXPECT_EQ(sum(Pack(Pack::V{1e16, 1.0, -1e16, 1.0})), ((1e16 + 1.0) - 1e16) + 1.0);
}

TEST(Pack, TransposesRowsToColumns)
{
    Pack p[4];
    for (int i = 0; i < 4; ++i)
        p[i] = Pack(Pack::V{10.0 * i, 10.0 * i + 1, 10.0 * i + 2, 10.0 * i + 3});
    transpose(p[0], p[1], p[2], p[3]);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            EXPECT_EQ(p[i].v[j], 10.0 * j + i);
}

TEST(Mask, HoldsPerLane)
{
    const Mask m = Pack::load(a.data()) > Pack(0.0);
    EXPECT_TRUE(any(m));
    EXPECT_FALSE(any(m & !m));
    EXPECT_EQ(values(select(m, 1.0, 2.0)), (std::array<double, 4>{1.0, 2.0, 2.0, 1.0}));
    EXPECT_FALSE(any(Pack(nan) < Pack(inf)));
}
}  // namespace
}  // namespace hdem
