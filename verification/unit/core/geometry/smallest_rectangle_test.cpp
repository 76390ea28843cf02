#include "core/geometry/smallest_rectangle.h"
#include "core/geometry/unit_direction.h"

#include <gtest/gtest.h>

#include <random>

namespace hdem
{
namespace
{
double area_of(const std::vector<Vec2>& points)
{
    SmallestRectangle around;
    around.add(points);
    return around.area();
}

std::vector<Vec2> turned(std::vector<Vec2> points, double degrees)
{
    const Vec2 d = unit_direction(degrees);
    for (Vec2& p : points)
        p = p.x() * d + p.y() * turned_left(d);
    return points;
}

TEST(SmallestRectangle, OfARectangleIsThatRectangleWhicheverWayItLies)
{
    for (const double degrees : {0.0, 12.0, 37.0, 45.0, 90.0, 123.0})
        EXPECT_NEAR(area_of(turned({{0, 0}, {3, 0}, {3, 0.5}, {0, 0.5}}, degrees)), 1.5, 1e-14) << degrees;
}

TEST(SmallestRectangle, OfATriangleIsTwiceItsArea)
{
    EXPECT_NEAR(area_of({{0, 0}, {4, 0}, {1, 3}}), 12.0, 1e-14);
}

TEST(SmallestRectangle, OfManyPointsAddedInPiecesIsNoGreaterThanAlongAnyDirection)
{
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> along(0.0, 7.0);
    std::uniform_real_distribution<double> across(0.0, 2.0);
    SmallestRectangle around;
    for (int piece = 0; piece < 300; ++piece)
    {
        std::vector<Vec2> points;
        for (int k = 0; k < 40; ++k)
            points.emplace_back(along(random), across(random));
        around.add(turned(points, 20.0));
    }
    around.add(turned({{0, 0}, {7, 0}, {7, 2}, {0, 2}}, 20.0));
    EXPECT_NEAR(around.area(), 14.0, 1e-13);
}

TEST(SmallestRectangle, OfPointsOnALineAndOfNoneIsZero)
{
    EXPECT_EQ(SmallestRectangle().area(), 0.0);
    EXPECT_NEAR(area_of({{0, 0}, {1, 1}, {2, 2}}), 0.0, 1e-15);
}
}  // namespace
}  // namespace hdem
