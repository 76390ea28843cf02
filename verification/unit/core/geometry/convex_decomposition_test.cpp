#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost 1.74 includes one of its own

#include "core/geometry/convex_decomposition.h"
#include "core/geometry/unit_direction.h"

#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/intersection.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hdem
{
namespace
{
CutPolygon tagged(const Polygon& polygon)
{
    CutPolygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        out.add(polygon[i], {static_cast<std::int32_t>(i), no_index});
    }
    return out;
}

/// Convex parts without overlap, with the area of the whole, in which each edge of the polygon occurs whole and once and every internal
/// edge twice.
void expect_sound(const Polygon& polygon, const std::vector<CutPolygon>& parts)
{
    double area = 0.0;
    std::vector<int> times(polygon.size(), 0);
    std::size_t internal = 0;
    for (const CutPolygon& part : parts)
    {
        EXPECT_TRUE(is_convex(part.vertices, 1e-10));
        area += signed_area(part.vertices);
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
        {
            const std::int32_t source = part.edges[i].source;
            if (source == edge_internal)
            {
                ++internal;
                continue;
            }
            const auto edge = static_cast<std::size_t>(source);
            ++times[edge];
            EXPECT_EQ(part.vertices[i], polygon[edge]);
            EXPECT_EQ(part.vertices[next(i, part.vertices.size())], polygon[next(edge, polygon.size())]);
        }
    }
    EXPECT_NEAR(area, signed_area(polygon), 1e-13 * (1.0 + area));
    EXPECT_EQ(times, std::vector<int>(polygon.size(), 1));
    EXPECT_EQ(internal, 2 * (parts.size() - 1)) << "parts of a polygon without holes form a tree";
    for (std::size_t a = 0; a < parts.size(); ++a)
    {
        for (std::size_t b = 0; b < a; ++b)
        {
            EXPECT_NEAR(convex_overlap_area(parts[a].vertices, parts[b].vertices), 0.0, 1e-13);
        }
    }
}

/// Random points joined in random order, then crossings undone one by one: each step shortens the boundary, so it ends.
Polygon random_simple_polygon(std::mt19937& engine, std::size_t vertices)
{
    std::uniform_real_distribution<double> coordinate(0.0, 1.0);
    Polygon polygon(vertices);
    for (Vec2& p : polygon)
    {
        p = {coordinate(engine), coordinate(engine)};
    }
    while (const auto crossing = find_self_crossing(polygon))
    {
        std::reverse(polygon.begin() + static_cast<std::ptrdiff_t>(crossing->edge_a + 1),
                     polygon.begin() + static_cast<std::ptrdiff_t>(crossing->edge_b + 1));
    }
    make_anticlockwise(polygon);
    return polygon;
}

TEST(ConvexParts, OfAConvexPolygonAreThePolygonItself)
{
    const Polygon polygon = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}};
    const auto parts = convex_parts(tagged(polygon));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].vertices, polygon);
}

TEST(ConvexParts, OfAnLShapeAreTwo)
{
    const Polygon polygon = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
    const auto parts = convex_parts(tagged(polygon));
    EXPECT_EQ(parts.size(), 2u);
    expect_sound(polygon, parts);
}

TEST(ConvexParts, OfACombAreSound)
{
    Polygon comb;
    for (int i = 0; i < 12; ++i)
    {
        comb.emplace_back(i, i % 2 == 0 ? 0.0 : -2.0);
    }
    comb.emplace_back(11.0, 1.0);
    comb.emplace_back(5.5, 1.0);  // a straight vertex
    comb.emplace_back(0.0, 1.0);
    ASSERT_FALSE(find_self_crossing(comb));
    expect_sound(comb, convex_parts(tagged(comb)));
}

/// Polygons of which a way that looks at all vertices for each takes hours.
TEST(ConvexParts, OfManyVerticesAreAsManyAsTheyMustBe)
{
    constexpr int teeth = 50'000;
    Polygon comb = {{0.0, -1.0}, {2.0 * teeth, -1.0}};
    for (int i = teeth - 1; i >= 0; --i)
        for (const Vec2& p : {Vec2(1.5, 0.0), Vec2(1.2, 5.0), Vec2(0.8, 5.0), Vec2(0.5, 0.0)})
            comb.push_back(p + Vec2(2.0 * i, 0.0));
    Polygon star;
    for (int i = 0; i < 2 * teeth; ++i)
        star.push_back((i % 2 == 0 ? 1.0 : 0.4) * unit_direction(180.0 * i / teeth));
    for (const Polygon& polygon : {comb, star})
    {
        const auto parts = convex_parts(tagged(polygon));
        EXPECT_EQ(parts.size(), teeth + 1u) << "the body and its teeth";
        double area = 0.0;
        for (const CutPolygon& part : parts)
            area += signed_area(part.vertices);
        EXPECT_NEAR(area, signed_area(polygon), 1e-9 * area);
    }
}

TEST(ConvexParts, OfRandomSimplePolygonsAreSound)
{
    std::mt19937 engine(20240607);
    for (int i = 0; i < 400; ++i)
    {
        const Polygon polygon = random_simple_polygon(engine, 4 + static_cast<std::size_t>(i) % 25);
        SCOPED_TRACE(i);
        const auto parts = convex_parts(tagged(polygon));
        expect_sound(polygon, parts);
        std::size_t reflex = 0;
        for (std::size_t k = 0; k < polygon.size(); ++k)
        {
            reflex += turn(polygon, k) < 0.0 ? 1 : 0;
        }
        EXPECT_LE(parts.size(), 2 * reflex + 1) << "Hertel, Mehlhorn: at most two internal edges a reflex vertex";
        if (HasFailure())
        {
            break;
        }
    }
}

TEST(OverlapArea, OfConcavePolygonsIsTheClosedForm)
{
    const Polygon l_shape = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
    const Polygon reversed(l_shape.rbegin(), l_shape.rend());
    EXPECT_NEAR(overlap_area(l_shape, reversed), 4.0, 1e-15);
    EXPECT_NEAR(overlap_area(l_shape, {{1, 1}, {3, 1}, {3, 2}, {1, 2}}), 0.0, 1e-15) << "they touch";
    EXPECT_NEAR(overlap_area(l_shape, {{0.5, 0.5}, {2.5, 0.5}, {2.5, 1.5}, {0.5, 1.5}}), 1.25, 1e-15);
}

TEST(OverlapArea, OfRandomPolygonsAgreesWithBoostGeometry)
{
    namespace bg = boost::geometry;
    using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>>;
    const auto to_boost = [](const Polygon& polygon)
    {
        BoostPolygon out;
        for (const Vec2& p : polygon)
        {
            bg::append(out.outer(), bg::model::d2::point_xy<double>(p.x(), p.y()));
        }
        bg::correct(out);
        return out;
    };
    std::mt19937 engine(7);
    for (std::size_t i = 0; i < 200; ++i)
    {
        const Polygon a = random_simple_polygon(engine, 3 + i % 12);
        const Polygon b = random_simple_polygon(engine, 3 + i % 7);
        bg::model::multi_polygon<BoostPolygon> common;
        bg::intersection(to_boost(a), to_boost(b), common);
        EXPECT_NEAR(overlap_area(a, b), bg::area(common), 1e-13);
    }
}

TEST(OverlapArea, OfPolygonsThatTouchUpToRoundOffIsZero)
{
    // Boost 1.74 returns the whole area of the first, 0.886.
    const Polygon block = {{7.2212478295798128, 13.844760189476389},
                           {6.784123790049887, 13.570556895318237},
                           {6.5200961494664007, 12.745233532358045},
                           {6.6989197710328563, 12.161999435751415},
                           {7.2212478295798128, 12.161999435751415}};
    const Polygon kite = {{8.0065276706533339, 7.8972300201100856},
                          {6.5188484219289942, 12.749303001686066},
                          {3.5029163712640177, 7.8972300201100856},
                          {6.5188484219289933, 3.2048272815239178}};
    EXPECT_NEAR(overlap_area(block, kite), 0.0, 1e-14);
}

TEST(MergedParts, LoseTheStraightVertexBetweenEdgesOfOneChord)
{
    Chords chords;
    std::vector<CutPolygon> whole = {tagged({{0, 0}, {2, 0}, {2, 1}, {0, 1}})};
    give_chords(whole, chords);
    ConvexCut cut = plan_cut(whole[0], {{0.7, 0.0}, unit_direction(80.0)}, edge_internal, chords, 1e-9);
    commit(cut, chords);
    std::vector<CutPolygon> parts = {cut.left, cut.right};
    merge_convex_parts(parts);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].vertices.size(), 4u);
    EXPECT_DOUBLE_EQ(signed_area(parts[0].vertices), 2.0);
}
}  // namespace
}  // namespace hdem
