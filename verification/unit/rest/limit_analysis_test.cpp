#include "core/geometry/polygon.h"
#include "verification/rest/limit_analysis.h"
#include "verification/rest/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hdem::verification::rest
{
namespace
{
constexpr double gap = 1e-6;

/// A plane of that dip, and a block of base 1 on it.
std::vector<Body> on_slope(double dip_deg, double height)
{
    const Vec2 down = direction(-dip_deg);
    return {body_of(rectangle_along(-10.0 * down - turned_left(down), down, 20.0, 1.0), rock, true),
            body_of(rectangle_along({0.0, 0.0}, down, 1.0, height), rock, false)};
}

double unbalance(const std::vector<Body>& bodies, const Strength& strength)
{
    return least_unbalance(bodies, find_touching(bodies, gap, gap), strength, {0.0, -g});
}

/// Half-circular, mean radius 1, of `count` blocks between two fixed ones.
std::vector<Body> arch(int count, double thickness)
{
    const double inner = 1.0 - 0.5 * thickness, outer = 1.0 + 0.5 * thickness;
    std::vector<Body> bodies{body_of(rectangle(inner - 0.1, -1.0, outer + 0.1, 0.0), rock, true),
                             body_of(rectangle(-outer - 0.1, -1.0, -inner + 0.1, 0.0), rock, true)};
    for (int i = 0; i < count; ++i)
    {
        const Vec2 from = direction(180.0 * i / count), to = direction(180.0 * (i + 1) / count);
        bodies.push_back(body_of({inner * from, outer * from, outer * to, inner * to}, rock, false));
    }
    return bodies;
}

TEST(LimitAnalysis, BlockOnASlopeStandsUpToItsFrictionAngle)
{
    const std::vector<Body> bodies = on_slope(30.0, 0.5);
    EXPECT_LT(unbalance(bodies, {std::tan(radians(30.01)), 0.0}), 1e-9);
    // What friction lacks along the slope, shared out over x and y.
    EXPECT_GT(unbalance(bodies, {std::tan(radians(29.0)), 0.0}), 1e-3);
}

TEST(LimitAnalysis, CohesionCountsWithTheWholeLengthOfTheFace)
{
    const std::vector<Body> bodies = on_slope(30.0, 0.5);
    const double driving = rock * 0.5 * g * std::sin(radians(30.0));
    EXPECT_LT(unbalance(bodies, {0.0, 1.001 * driving}), 1e-9);
    EXPECT_GT(unbalance(bodies, {0.0, 0.99 * driving}), 1e-4);
}

TEST(LimitAnalysis, StrengthFactorIsThatOfTheClosedForm)
{
    const std::vector<Body> bodies = on_slope(25.0, 0.5);
    const Strength strength{std::tan(radians(35.0)), 500.0};
    const double weight = rock * 0.5 * g;
    const double factor = (weight * std::cos(radians(25.0)) * strength.friction + strength.cohesion) /
                          (weight * std::sin(radians(25.0)));
    EXPECT_NEAR(strength_factor(bodies, find_touching(bodies, gap, gap), strength, {0.0, -g}), factor, 1e-5 * factor);
}

TEST(LimitAnalysis, TallBlockTopplesWhereItsWeightLeavesTheBase)
{
    const double height = 2.0, critical_deg = std::atan(1.0 / height) / radians(1.0);
    EXPECT_LT(unbalance(on_slope(critical_deg - 0.1, height), {2.0, 0.0}), 1e-9);
    EXPECT_GT(unbalance(on_slope(critical_deg + 0.5, height), {2.0, 0.0}), 1e-3);
}

TEST(LimitAnalysis, BlockInTheAirLacksAllOfItsWeight)
{
    std::vector<Body> bodies = on_slope(0.0, 1.0);
    bodies.push_back(body_of(rectangle(3.0, 0.1, 4.0, 1.1), rock, false));
    EXPECT_NEAR(unbalance(bodies, {0.5, 0.0}), 1.0, 1e-9);
}

TEST(LimitAnalysis, FewestThicknessOfAHalfCircularArchIsThatOfTheTables)
{
    // Without sliding, many blocks: 0.1075 of the mean radius [Milankovitch 1907; Heyman 1969 with 0.106 of the mid-line weight].
    constexpr int count = 60;
    constexpr double friction = 5.0;
    EXPECT_LT(unbalance(arch(count, 0.109), {friction, 0.0}), 1e-9);
    EXPECT_GT(unbalance(arch(count, 0.105), {friction, 0.0}), 1e-9);
}

TEST(LimitAnalysis, LoadMultiplierOfABeamOnTwoPointsIsThatOfTheLever)
{
    // A beam of length 4 on a support from 0 to 3: pushed down at its free end by P it lifts at P (4 - 3) = W (3 - 2).
    const std::vector<Body> bodies{body_of(rectangle(0.0, -1.0, 3.0, 0.0), rock, true),
                                   body_of(rectangle(0.0, 0.0, 4.0, 1.0), rock, false)};
    const double weight = rock * 4.0 * g;
    const Loads dead = weights(bodies, {0.0, -g});
    const Loads live{{0.0, 0.0, 0.0}, {0.0, -1.0, -2.0}};  // 1 N at x = 4
    const std::vector<TouchingPoint> points = find_touching(bodies, gap, gap);
    const std::optional<double> most = load_multiplier(bodies, points, {0.5, 0.0}, dead, live);
    ASSERT_TRUE(most.has_value());
    EXPECT_NEAR(*most, weight, 1e-6 * weight);
    const Loads over_support{{0.0, 0.0, 0.0}, {0.0, -1.0, -0.5}};
    EXPECT_TRUE(std::isinf(load_multiplier(bodies, points, {0.5, 0.0}, dead, over_support).value_or(0.0)));
    const Loads beyond{{0.0, 0.0, 0.0}, {0.0, -weight, -2.0 * 1.1 * weight}};
    EXPECT_FALSE(load_multiplier(bodies, points, {0.5, 0.0}, beyond, live).has_value());
}

TEST(Touching, FacesGiveTheEndsOfTheirCommonStretch)
{
    const std::vector<Body> bodies{body_of(rectangle(0.0, 0.0, 2.0, 1.0), rock, true),
                                   body_of(rectangle(1.0, 1.0, 4.0, 2.0), rock, false)};
    const std::vector<TouchingPoint> points = find_touching(bodies, gap, gap);
    ASSERT_EQ(points.size(), 2U);
    for (const TouchingPoint& point : points)
    {
        EXPECT_NEAR(point.length, 0.5, 1e-12);
        EXPECT_NEAR(point.normal.y(), 1.0, 1e-12);
        EXPECT_NEAR(point.place.y(), 1.0, 1e-12);
    }
    EXPECT_NEAR(points[0].place.x() + points[1].place.x(), 3.0, 1e-12);
}

TEST(Touching, CornerOnAFaceHasNoLengthAndTheNormalOfTheFace)
{
    const std::vector<Body> bodies{body_of(rectangle(-5.0, -1.0, 5.0, 0.0), rock, true),
                                   body_of({{0.0, 0.0}, {1.0, 1.0}, {-1.0, 1.0}}, rock, false)};
    const std::vector<TouchingPoint> points = find_touching(bodies, gap, gap);
    ASSERT_FALSE(points.empty());
    for (const TouchingPoint& point : points)
    {
        EXPECT_NEAR(point.place.norm(), 0.0, 1e-5);
        EXPECT_LT(point.length, 1e-5);
        EXPECT_NEAR(point.normal.y(), 1.0, 1e-12);
    }
}

TEST(Touching, NothingTouchesBeyondTheGap)
{
    const std::vector<Body> bodies{body_of(rectangle(0.0, 0.0, 1.0, 1.0), rock, true),
                                   body_of(rectangle(0.0, 1.001, 1.0, 2.0), rock, false)};
    EXPECT_TRUE(find_touching(bodies, 0.9e-3, 1e-3).empty());
    EXPECT_EQ(find_touching(bodies, 1.1e-3, 1e-3).size(), 2U);
}

TEST(Touching, HollowCornersTouchWithBothSidesAndNeverWithinTheBlock)
{
    const Polygon angle{{0.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {1.0, 1.0}, {1.0, 3.0}, {0.0, 3.0}};
    const std::vector<Body> bodies{body_of(angle, rock, true), body_of(rectangle(1.0, 1.0, 2.0, 2.0), rock, false)};
    ASSERT_EQ(bodies[0].parts.size(), 2U);
    EXPECT_NEAR(bodies[0].mass, 5.0 * rock, 1e-9);
    double upwards = 0.0, aside = 0.0;
    for (const TouchingPoint& point : find_touching(bodies, gap, gap))
    {
        const Vec2 normal = (point.first == 0 ? 1.0 : -1.0) * point.normal;
        upwards += normal.y() > 0.999 ? point.length : 0.0;
        aside += normal.x() > 0.999 ? point.length : 0.0;
        EXPECT_GT(std::max(normal.x(), normal.y()), 0.999);
    }
    EXPECT_NEAR(upwards, 1.0, 1e-5);
    EXPECT_NEAR(aside, 1.0, 1e-5);
}

TEST(Touching, OverlapIsTheLeastWayApart)
{
    const Body a = body_of(rectangle(0.0, 0.0, 1.0, 1.0), rock, false);
    EXPECT_NEAR(overlap_depth(a, body_of(rectangle(0.7, 0.9, 1.7, 1.9), rock, false)), 0.1, 1e-12);
    EXPECT_EQ(overlap_depth(a, body_of(rectangle(1.1, 0.0, 2.0, 1.0), rock, false)), 0.0);
}
}  // namespace
}  // namespace hdem::verification::rest
