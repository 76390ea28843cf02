#include "core/water/pore_pressure.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
/// 10 kN/m3, y upwards.
Water under(std::vector<Vec2> table)
{
    Water water;
    water.given = true;
    water.unit_weight = 1e4;
    water.tables = {{std::move(table)}};
    water.table_of_stage = {0};
    water.tolerance = 1e-4;
    return water;
}

void expect_sum(const PressureSum& sum, double force, double moment)
{
    EXPECT_NEAR(sum.force, force, 1e-9 * std::abs(force) + 1e-9);
    EXPECT_NEAR(sum.moment, moment, 1e-9 * std::abs(moment) + 1e-9);
}

TEST(PorePressure, GrowsBelowTheLevel)
{
    const Water water = under({{0.0, 5.0}});
    expect_sum(pressure_along(water, 0, {0, 2}, {4, 2}), 1.2e5, 2.4e5);
    // 30 to 50 kPa over 2 m: ends (2 p1 + p2) L/6 and (p1 + 2 p2) L/6.
    expect_sum(pressure_along(water, 0, {0, 2}, {0, 0}), 8e4, 2.0 * (30e3 + 2.0 * 50e3) * 2.0 / 6.0);
    expect_sum(pressure_along(water, 0, {0, 6}, {4, 6}), 0.0, 0.0);
}

TEST(PorePressure, IsCutWhereTheStretchLeavesTheWater)
{
    const Water water = under({{0.0, 1.0}});
    // 0 at 1 m of 3 m, 20 kPa at the end: a triangle of 2 m.
    expect_sum(pressure_along(water, 0, {0, 2}, {0, -1}), 2e4, 2e4 * (1.0 + 4.0 / 3.0));
    expect_sum(pressure_along(water, 0, {0, -1}, {0, 2}), 2e4, 2e4 * 2.0 / 3.0);
}

TEST(PorePressure, BendsWithTheTable)
{
    const Water water = under({{0.0, 4.0}, {2.0, 2.0}, {6.0, 2.0}});
    // On y = 0: 40 to 20 kPa over 2 m, then 20 kPa over 4 m.
    expect_sum(pressure_along(water, 0, {0, 0}, {6, 0}), 6e4 + 8e4, 2.0 * (40e3 + 2.0 * 20e3) * 2.0 / 6.0 + 8e4 * 4.0);
    const PressureSum left = pressure_along(water, 0, {-3, 0}, {0, 0});
    expect_sum(left, 1.2e5, 1.8e5);
}

TEST(PorePressure, TurnsWithGravity)
{
    Water water = under({{0.0, 5.0}});
    water.up = {1.0, 0.0};
    expect_sum(pressure_along(water, 0, {2, 0}, {2, 4}), 1.2e5, 2.4e5);
}

TEST(PorePressure, FallsAlongTheOutletOfACrack)
{
    Water water = under({{0.0, -100.0}});
    water.cracks = {{.crack = {{8, 6}, {8, 2}}, .outlet = {{8, 2}, {4, 0}, {0, 0}}, .level = 5.0}};
    expect_sum(pressure_along(water, 0, {8, 6}, {8, 2}), 0.5 * 3e4 * 3.0, 4.5e4 * 3.0);
    // Way sqrt(20) + 4, 30 kPa at the foot.
    const double length = std::sqrt(20.0) + 4.0, at_bend = 3e4 * 4.0 / length;
    expect_sum(pressure_along(water, 0, {4, 0}, {0, 0}), 0.5 * at_bend * 4.0, at_bend * 16.0 / 6.0);
    // A joint that runs on beyond the outlet, and one that only crosses it.
    expect_sum(pressure_along(water, 0, {4, 0}, {-5, 0}), 0.5 * at_bend * 4.0, at_bend * 16.0 / 6.0);
    expect_sum(pressure_along(water, 0, {2, -1}, {2, 1}), 0.0, 0.0);
}

TEST(PorePressure, OfAFieldIsLinearInTriangles)
{
    Water water = under({});
    water.tables.clear();
    water.table_of_stage = {no_index};
    const auto plane = [](const Vec2& p) { return 7e3 + 2e3 * p.x() - 1e3 * p.y(); };
    for (const Vec2& p : {Vec2(0, 0), Vec2(10, 0), Vec2(10, 7), Vec2(0, 7), Vec2(3, 2), Vec2(6, 5)})
    {
        water.field.points.push_back(p);
        water.field.pressure.push_back(plane(p));
    }
    ASSERT_TRUE(make_triangles(water.field));
    const Vec2 a(1, 1), b(9, 5);
    const double length = (b - a).norm();
    const PressureSum sum = pressure_along(water, 0, a, b);
    EXPECT_NEAR(sum.force, 0.5 * (plane(a) + plane(b)) * length, 1e-6 * sum.force);
    EXPECT_NEAR(sum.moment, length * length * (plane(a) + 2.0 * plane(b)) / 6.0, 1e-6 * sum.moment);
    PressureField line{.points = {{0, 0}, {1, 1}, {2, 2}}, .pressure = {0, 0, 0}, .triangle = {}};
    EXPECT_FALSE(make_triangles(line));
}

/// Points near a joint, and four far around them: a stretch is followed from triangle to triangle, however much they differ in size.
TEST(PorePressure, OfAFieldIsFollowedThroughTrianglesOfAnySize)
{
    Water water = under({{0.0, 0.0}});
    const std::array<Vec2, 6> along{Vec2(-2.5, 0), Vec2(0, 0), Vec2(2, 90e3), Vec2(5, 60e3), Vec2(10, 0), Vec2(12.5, 0)};
    for (const double y : {-1.0, 0.0, 1.0})
        for (const Vec2& p : along)
        {
            water.field.points.emplace_back(p.x(), y);
            water.field.pressure.push_back(p.y());
        }
    for (const double x : {-95.0, 105.0})
        for (const double y : {-100.0, 100.0})
        {
            water.field.points.emplace_back(x, y);
            water.field.pressure.push_back(0.0);
        }
    ASSERT_TRUE(make_triangles(water.field));
    for (const double y : {0.0, -0.3, 0.5})
    {
        const PressureSum sum = pressure_along(water, 0, {0, y}, {10, y});
        EXPECT_NEAR(sum.force, 465e3, 1e-3) << y;
        EXPECT_NEAR(sum.moment, 120e3 + 225e3 * 3.4 + 150e3 * (5.0 + 5.0 / 3.0), 1e-2) << y;
        const PressureSum back = pressure_along(water, 0, {10, y}, {0, y});
        EXPECT_NEAR(back.force, sum.force, 1e-3);
        EXPECT_NEAR(back.moment, 10.0 * sum.force - sum.moment, 1e-2);
    }
}

/// A face that leaves the line of a crack bears its water as far as it lies within the tolerance.
TEST(PorePressure, OfACrackEndsWhereAFaceLeavesItsLine)
{
    Water water = under({{0.0, -100.0}});
    water.tolerance = 1e-4;
    water.cracks = {{.crack = {{0, 0}, {0, 2}}, .outlet = {{0, 0}, {-3, 0}}, .level = 2.0}};
    const double exact = pressure_along(water, 0, {0, 0}, {0, 2}).force;
    EXPECT_NEAR(exact, 0.5 * water.unit_weight * 4.0, 1e-6 * exact);
    const double beside = pressure_along(water, 0, {0, 0}, {2e-4, 2}).force;  // leaves it half way up
    EXPECT_NEAR(beside, 0.75 * exact, 1e-3 * exact);
    EXPECT_EQ(pressure_along(water, 0, {3e-4, 0}, {3e-4, 2}).force, 0.0);
}
}  // namespace
}  // namespace hdem
