#include "core/geometry/polygon.h"
#include "core/geometry/unit_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
Polygon rectangle(const Vec2& low, double width, double height)
{
    return {low, low + Vec2(width, 0.0), low + Vec2(width, height), low + Vec2(0.0, height)};
}

Polygon turned(Polygon polygon, double degrees)
{
    const Vec2 d = unit_direction(degrees);
    for (Vec2& p : polygon)
    {
        p = p.x() * d + p.y() * turned_left(d);
    }
    return polygon;
}

const Polygon l_shape = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};

TEST(AreaMoments, OfARectangleAreTheClosedForm)
{
    const AreaMoments m = area_moments(turned(rectangle({-1.0, -0.5}, 2.0, 1.0), 33.0));
    EXPECT_NEAR(m.area, 2.0, 1e-15);
    EXPECT_NEAR(m.centroid.norm(), 0.0, 1e-15);
    EXPECT_NEAR(m.polar, 2.0 * (4.0 + 1.0) / 12.0, 1e-15);  // A (w² + h²) / 12
}

TEST(AreaMoments, OfARightTriangleAreTheClosedForm)
{
    const double b = 3.0;
    const double h = 2.0;
    const AreaMoments m = area_moments({{0, 0}, {b, 0}, {0, h}});
    EXPECT_NEAR(m.area, b * h / 2.0, 1e-15);
    EXPECT_NEAR((m.centroid - Vec2(b / 3.0, h / 3.0)).norm(), 0.0, 1e-15);
    EXPECT_NEAR(m.polar, b * h * (b * b + h * h) / 36.0, 1e-14);
}

TEST(AreaMoments, OfARegularPolygonTendToThoseOfTheCircle)
{
    Polygon circle;
    for (int i = 0; i < 720; ++i)
    {
        circle.push_back(2.0 * unit_direction(0.5 * i));
    }
    const AreaMoments m = area_moments(circle);
    // The inscribed 720-gon lacks (π/720)²·2/3 of the area and twice that of the second moment.
    EXPECT_NEAR(m.area, 4.0 * std::numbers::pi, 2e-4);
    EXPECT_NEAR(m.polar, 8.0 * std::numbers::pi, 1e-3);
}

TEST(AreaMoments, DoNotDependOnOrientation)
{
    Polygon reversed(l_shape.rbegin(), l_shape.rend());
    EXPECT_LT(signed_area(reversed), 0.0);
    const AreaMoments a = area_moments(l_shape);
    const AreaMoments b = area_moments(reversed);
    EXPECT_NEAR(a.area, b.area, 1e-15);
    EXPECT_NEAR(a.polar, b.polar, 1e-14);
    EXPECT_NEAR((a.centroid - b.centroid).norm(), 0.0, 1e-15);
}

TEST(AreaMoments, KeepTheirDigitsAMillionMetresAway)
{
    const Vec2 far = {1048576.0, -2097152.0};  // powers of two: adding them to these coordinates is exact
    const Polygon near = {{0, 0}, {0.25, 0}, {0.375, 0.125}, {0.0625, 0.25}};
    Polygon moved = near;
    for (Vec2& p : moved)
    {
        p += far;
    }
    const AreaMoments a = area_moments(near);
    const AreaMoments b = area_moments(moved);
    EXPECT_DOUBLE_EQ(a.area, b.area);
    EXPECT_NEAR(a.polar, b.polar, 1e-9 * a.polar);  // the centroid itself is rounded to 2e-10 m there
    EXPECT_NEAR((b.centroid - far - a.centroid).norm(), 0.0, 1e-9);
}

TEST(CombinedMoments, OfThePartsAreThoseOfTheWhole)
{
    const AreaMoments whole = area_moments(l_shape);
    const AreaMoments parts = combined({area_moments(rectangle({0, 0}, 3, 1)), area_moments(rectangle({0, 1}, 1, 1))});
    EXPECT_NEAR(whole.area, parts.area, 1e-15);
    EXPECT_NEAR(whole.polar, parts.polar, 1e-14);
    EXPECT_NEAR((whole.centroid - parts.centroid).norm(), 0.0, 1e-15);
}

TEST(Orientation, IsMadeAnticlockwise)
{
    Polygon clockwise(l_shape.rbegin(), l_shape.rend());
    EXPECT_TRUE(make_anticlockwise(clockwise));
    EXPECT_EQ(clockwise, l_shape);
    EXPECT_FALSE(make_anticlockwise(clockwise));
}

TEST(Convexity, AcceptsStraightVerticesAndRefusesReflexOnes)
{
    EXPECT_TRUE(is_convex({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}));
    EXPECT_FALSE(is_convex(l_shape));
    EXPECT_FALSE(is_convex({{0, 0}, {0, 1}, {1, 1}, {1, 0}})) << "clockwise";
}

TEST(SelfCrossing, NamesTheEdgesAndThePoint)
{
    const auto crossing = find_self_crossing({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
    ASSERT_TRUE(crossing);
    EXPECT_EQ(crossing->edge_a, 0u);
    EXPECT_EQ(crossing->edge_b, 2u);
    EXPECT_NEAR((crossing->point - Vec2(1, 1)).norm(), 0.0, 1e-15);
}

TEST(SelfCrossing, IsFoundForTouchesSpikesAndRepeatedVertices)
{
    EXPECT_TRUE(find_self_crossing({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}})) << "a vertex on an edge";
    EXPECT_TRUE(find_self_crossing({{0, 0}, {4, 0}, {2, 0}, {2, 2}})) << "an edge folds back";
    EXPECT_TRUE(find_self_crossing({{0, 0}, {4, 0}, {2, 0}})) << "a triangle without area";
    EXPECT_TRUE(find_self_crossing({{0, 0}, {1, 0}, {1, 0}, {0, 1}})) << "a vertex given twice";
    EXPECT_FALSE(find_self_crossing(l_shape));
    EXPECT_FALSE(find_self_crossing({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}})) << "straight vertices are no crossing";
}

TEST(PointInPolygon, FollowsTheConcaveBoundary)
{
    EXPECT_TRUE(contains(l_shape, {0.5, 1.5}));
    EXPECT_TRUE(contains(l_shape, {2.5, 0.5}));
    EXPECT_FALSE(contains(l_shape, {2.5, 1.5}));
    EXPECT_FALSE(contains(l_shape, {-0.1, 1.0}));
    EXPECT_NEAR(distance_to_boundary(l_shape, {2.0, 2.0}), 1.0, 1e-15);
    EXPECT_NEAR(distance_to_boundary(l_shape, {4.0, -1.0}), std::sqrt(2.0), 1e-15);
}

TEST(ConvexOverlapArea, OfTurnedSquaresIsTheClosedForm)
{
    const Polygon square = rectangle({-0.5, -0.5}, 1.0, 1.0);
    const Polygon at_45 = turned(square, 45.0);
    const double octagon = 2.0 * (std::sqrt(2.0) - 1.0);
    EXPECT_NEAR(convex_overlap_area(square, at_45), octagon, 1e-14);
}

TEST(ConvexOverlapArea, OfTouchingPolygonsIsZero)
{
    EXPECT_EQ(convex_overlap_area(rectangle({0, 0}, 1, 1), rectangle({1, 0}, 1, 1)), 0.0);
}

TEST(UnitDirection, IsExactAtQuarterTurnsAndWithinTwoUlpElsewhere)
{
    EXPECT_EQ(unit_direction(0.0), Vec2(1, 0));
    EXPECT_EQ(unit_direction(90.0), Vec2(0, 1));
    EXPECT_EQ(unit_direction(-90.0), Vec2(0, -1));
    EXPECT_EQ(unit_direction(180.0), Vec2(-1, 0));
    EXPECT_EQ(unit_direction(450.0), Vec2(0, 1));
    for (int i = -4000; i <= 4000; ++i)
    {
        const double degrees = 0.0917 * i;
        const Vec2 d = unit_direction(degrees);
        const double x = degrees * std::numbers::pi / 180.0;  // itself rounded: error up to 1e-15 at 370°
        EXPECT_NEAR(d.x(), std::cos(x), 2e-15) << degrees;
        EXPECT_NEAR(d.y(), std::sin(x), 2e-15) << degrees;
    }
}

TEST(UnitDirection, OfMirroredAnglesIsMirroredExactly)
{
    for (int i = 0; i < 500; ++i)
    {
        const double degrees = 0.180 * i;
        const Vec2 a = unit_direction(degrees);
        EXPECT_EQ(unit_direction(-degrees), Vec2(a.x(), -a.y()));
    }
}
}  // namespace
}  // namespace hdem
