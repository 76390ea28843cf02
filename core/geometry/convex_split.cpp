#include "core/geometry/convex_split.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hdem
{
namespace
{
/// Distances of the vertices from the line, 0 for those the line goes through.
void snapped_sides(const Polygon& polygon, const CutLine& line, double tolerance, std::vector<double>& side)
{
    const std::size_t n = polygon.size();
    side.resize(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        const double s = line.side(polygon[i]);
        side[i] = std::abs(s) < tolerance ? 0.0 : s;
    }
    // An edge shorter than the tolerance may have both ends at the line that crosses there: it goes to one side as a whole.
    for (std::size_t i = 0; i < n; ++i)
    {
        const std::size_t j = next(i, n);
        if (side[i] == 0.0 && side[j] == 0.0)
        {
            const double beyond = side[next(j, n)];
            side[j] = beyond != 0.0 ? std::copysign(tolerance, beyond) : tolerance;
        }
    }
}
}  // namespace

Index Chords::add(const Vec2& from, const Vec2& to)
{
    chords_.push_back({from, to, {}});
    return static_cast<Index>(chords_.size() - 1);
}

double Chords::position(Index chord, const Vec2& p) const
{
    const Chord& c = chords_[static_cast<std::size_t>(chord)];
    const Vec2 d = c.to - c.from;
    return d.dot(p - c.from) / d.norm();
}

Vec2 Chords::crossing(Index chord, const CutLine& line, double tolerance) const
{
    const Chord& c = chords_[static_cast<std::size_t>(chord)];
    const double side_from = line.side(c.from);
    const double side_to = line.side(c.to);
    Vec2 at = c.from + (c.to - c.from) * (side_from / (side_from - side_to));
    if (c.points.empty())
    {
        return at;
    }
    const double where = position(chord, at);
    const auto after = std::lower_bound(c.points.begin(), c.points.end(), where,
                                        [](const Point& p, double position) { return p.position < position; });
    if (after != c.points.end() && std::abs(line.side(after->at)) < tolerance)
    {
        return after->at;
    }
    if (after != c.points.begin() && std::abs(line.side(std::prev(after)->at)) < tolerance)
    {
        return std::prev(after)->at;
    }
    return at;
}

void Chords::record(Index chord, const Vec2& p)
{
    const double where = position(chord, p);
    std::vector<Point>& points = chords_[static_cast<std::size_t>(chord)].points;
    const auto after = std::lower_bound(points.begin(), points.end(), where,
                                        [](const Point& q, double position) { return q.position < position; });
    if (after == points.end() || after->at != p)
    {
        points.insert(after, {where, p});
    }
}

Side side_of(const Polygon& polygon, const CutLine& line, double tolerance)
{
    double least = 0.0;
    double most = 0.0;
    for (const Vec2& p : polygon)
    {
        const double s = line.side(p);
        least = std::min(least, s);
        most = std::max(most, s);
    }
    if (least <= -tolerance && most >= tolerance)
    {
        return Side::crossed;
    }
    return most >= -least ? Side::left : Side::right;
}

ConvexCut plan_cut(const CutPolygon& polygon, const CutLine& line, std::int32_t source, const Chords& chords, double tolerance)
{
    static thread_local std::vector<double> side;  // one allocation for millions of cuts
    snapped_sides(polygon.vertices, line, tolerance, side);
    const std::size_t n = polygon.vertices.size();
    const EdgeTag cut_edge = {source, no_index};
    ConvexCut cut;
    cut.left.vertices.reserve(n + 1);
    cut.left.edges.reserve(n + 1);
    cut.right.vertices.reserve(n + 1);
    cut.right.edges.reserve(n + 1);
    std::size_t new_points = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
        const std::size_t j = next(i, n);
        const Vec2& vertex = polygon.vertices[i];
        const EdgeTag& edge = polygon.edges[i];
        if (side[i] >= 0.0)
        {
            const bool leaves = side[i] == 0.0 && side[j] < 0.0;
            cut.left.add(vertex, leaves ? cut_edge : edge);
            cut.from = leaves ? vertex : cut.from;
        }
        if (side[i] <= 0.0)
        {
            const bool leaves = side[i] == 0.0 && side[j] > 0.0;
            cut.right.add(vertex, leaves ? cut_edge : edge);
            cut.to = leaves ? vertex : cut.to;
        }
        if ((side[i] > 0.0 && side[j] < 0.0) || (side[i] < 0.0 && side[j] > 0.0))
        {
            const Vec2 at = chords.crossing(edge.chord, line, tolerance);
            cut.left.add(at, side[i] > 0.0 ? cut_edge : edge);
            cut.right.add(at, side[i] < 0.0 ? cut_edge : edge);
            (side[i] > 0.0 ? cut.from : cut.to) = at;
            HDEM_EXPECT(new_points < 2);
            cut.new_points[new_points++] = {edge.chord, at};
        }
    }
    return cut;
}

Index commit(ConvexCut& cut, Chords& chords)
{
    for (const ConvexCut::NewPoint& point : cut.new_points)
    {
        if (point.chord != no_index)
        {
            chords.record(point.chord, point.at);
        }
    }
    const Index chord = chords.add(cut.from, cut.to);
    for (CutPolygon* piece : {&cut.left, &cut.right})
    {
        for (EdgeTag& edge : piece->edges)
        {
            edge.chord = edge.chord == no_index ? chord : edge.chord;
        }
    }
    return chord;
}

void give_chords(std::vector<CutPolygon>& parts, Chords& chords)
{
    using Ends = std::array<double, 4>;
    std::map<Ends, Index> known;
    for (CutPolygon& part : parts)
    {
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
        {
            if (part.edges[i].chord != no_index)
            {
                continue;
            }
            const Vec2& a = part.vertices[i];
            const Vec2& b = part.vertices[next(i, part.vertices.size())];
            const auto opposite = known.find(Ends{b.x(), b.y(), a.x(), a.y()});
            part.edges[i].chord = opposite != known.end() ? opposite->second : chords.add(a, b);
            known[Ends{a.x(), a.y(), b.x(), b.y()}] = part.edges[i].chord;
        }
    }
}
}  // namespace hdem
