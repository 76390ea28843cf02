#include "core/geometry/convex_split.h"
#include "core/geometry/convex_union.h"
#include "core/geometry/unit_direction.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hdem
{
namespace
{
constexpr double tolerance = 1e-9;

/// Square [0, 2]² whose edges have sources 10, 11, 12, 13 (bottom, right, top, left).
struct Square
{
    Chords chords;
    CutPolygon polygon;

    Square()
    {
        polygon.vertices = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
        polygon.edges = {{10, no_index}, {11, no_index}, {12, no_index}, {13, no_index}};
        std::vector<CutPolygon> one = {polygon};
        give_chords(one, chords);
        polygon = one[0];
    }

    ConvexCut cut(const CutPolygon& what, const CutLine& line, std::int32_t source = 0)
    {
        EXPECT_EQ(side_of(what.vertices, line, tolerance), Side::crossed);
        ConvexCut out = plan_cut(what, line, source, chords, tolerance);
        commit(out, chords);
        return out;
    }
};

bool has_vertex(const CutPolygon& polygon, const Vec2& p)
{
    return std::find(polygon.vertices.begin(), polygon.vertices.end(), p) != polygon.vertices.end();
}

TEST(ConvexCut, LeavesPiecesWithTheirEdgesSources)
{
    Square square;
    const ConvexCut cut = square.cut(square.polygon, {{0.5, 0.0}, {0.0, 1.0}}, 7);
    EXPECT_DOUBLE_EQ(signed_area(cut.left.vertices), 1.0);
    EXPECT_DOUBLE_EQ(signed_area(cut.right.vertices), 3.0);
    const auto sources = [](const CutPolygon& p)
    {
        std::vector<std::int32_t> out;
        for (const EdgeTag& edge : p.edges)
        {
            out.push_back(edge.source);
        }
        std::sort(out.begin(), out.end());
        return out;
    };
    EXPECT_EQ(sources(cut.left), (std::vector<std::int32_t>{7, 10, 12, 13}));
    EXPECT_EQ(sources(cut.right), (std::vector<std::int32_t>{7, 10, 11, 12}));
}

TEST(ConvexCut, OfBothNeighboursMeetsTheirEdgeInTheSameBits)
{
    for (int i = 0; i < 200; ++i)
    {
        Square square;
        const ConvexCut halves = square.cut(square.polygon, {{0.7, 0.9}, unit_direction(71.0 + 0.13 * i)});
        const CutLine line = {{1.0 + 0.003 * i, 1.1}, unit_direction(-20.0 + 0.11 * i)};
        const ConvexCut a = square.cut(halves.left, line);
        const ConvexCut b = square.cut(halves.right, line);
        const double gap = std::min((a.from - b.to).norm(), (a.to - b.from).norm());
        EXPECT_EQ(gap, 0.0) << "angle " << i;
    }
}

TEST(ConvexCut, MeetsAnEdgeInTheSameBitsAlthoughTheNeighbourWasCutElsewhereBefore)
{
    for (int i = 0; i < 200; ++i)
    {
        Square square;
        const ConvexCut halves = square.cut(square.polygon, {{0.7, 0.9}, unit_direction(71.0 + 0.13 * i)});
        // Only the left half is cut by the first line, so that its edge is shorter than the right half's when the second comes.
        const ConvexCut lower = square.cut(halves.left, {{0.3, 0.4}, unit_direction(3.0)});
        const CutLine line = {{0.7, 1.1}, unit_direction(-20.0 + 0.11 * i)};
        const ConvexCut a = square.cut(lower.left, line);
        const ConvexCut b = square.cut(halves.right, line);
        EXPECT_EQ(std::min((a.from - b.to).norm(), (a.to - b.from).norm()), 0.0) << "angle " << i;
    }
}

TEST(ConvexCut, FindsTheNeighboursVertexOnAnEdgeItRunsThrough)
{
    // Lines through the neighbour's vertex up to round-off, on either side of it: not a second vertex next to it.
    for (const double off : {-1e-13, 0.0, 1e-13})
    {
        Square square;
        const ConvexCut halves = square.cut(square.polygon, {{0.7, 0.9}, unit_direction(80.0)});
        const ConvexCut left = square.cut(halves.left, {{0.3, 0.4}, unit_direction(3.0)});
        const Vec2 hanging = left.from.x() > left.to.x() ? left.from : left.to;
        const ConvexCut right = square.cut(halves.right, {hanging + Vec2(off, 0.0), unit_direction(-33.0)});
        EXPECT_TRUE(has_vertex(right.left, hanging)) << off;
        EXPECT_TRUE(has_vertex(right.right, hanging)) << off;
    }
}

TEST(ConvexCut, GoesThroughAVertexNearerThanTheTolerance)
{
    Square square;
    const ConvexCut cut = square.cut(square.polygon, {{1e-10, 0.0}, unit_direction(45.0)});
    EXPECT_EQ(cut.left.vertices.size(), 3u);
    EXPECT_EQ(cut.right.vertices.size(), 3u);
    EXPECT_TRUE(has_vertex(cut.left, {0, 0}));
    EXPECT_TRUE(has_vertex(cut.right, {0, 0}));
    EXPECT_DOUBLE_EQ(signed_area(cut.left.vertices), 2.0);
}

TEST(ConvexCut, DoesNotHappenAlongAnEdge)
{
    const Square square;
    EXPECT_EQ(side_of(square.polygon.vertices, {{0.0, 5e-10}, {1.0, 0.0}}, tolerance), Side::left);
    EXPECT_EQ(side_of(square.polygon.vertices, {{0.0, 2.0}, {1.0, 0.0}}, tolerance), Side::right);
}

TEST(SharedEdges, ThatOverlapInPartAreSplitAndMarkedOnBothSides)
{
    Square square;
    ConvexCut halves = square.cut(square.polygon, {{1.0, 0.0}, {0.0, 1.0}}, 5);
    ConvexCut left = square.cut(halves.left, {{0.0, 0.75}, {1.0, 0.0}}, 6);
    CutPolygon& upper = left.left;
    EXPECT_DOUBLE_EQ(shared_length(upper, halves.right, square.chords, tolerance), 1.25);
    set_shared_source(upper, halves.right, edge_internal, square.chords, tolerance);
    EXPECT_EQ(halves.right.vertices.size(), 5u);
    double internal = 0.0;
    double joint = 0.0;
    for (std::size_t i = 0; i < 5; ++i)
    {
        const double length = (halves.right.vertices[next(i, 5)] - halves.right.vertices[i]).norm();
        internal += halves.right.edges[i].source == edge_internal ? length : 0.0;
        joint += halves.right.edges[i].source == 5 ? length : 0.0;
    }
    EXPECT_DOUBLE_EQ(internal, 1.25);
    EXPECT_DOUBLE_EQ(joint, 0.75);
    EXPECT_EQ(connected_groups({upper, left.right, halves.right}, square.chords, tolerance), (std::vector<std::size_t>{0, 1, 0}));
}
}  // namespace
}  // namespace hdem
