#include "core/rock/block_outline.h"

#include "core/geometry/hole_joining.h"
#include "core/rock/weld.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace hdem
{
namespace
{
using Place = std::pair<double, double>;

Place place_of(const Vec2& p)
{
    return {p.x(), p.y()};
}

/// The edges at the outside of parts, found by where they begin.
class OuterEdges
{
  public:
    explicit OuterEdges(const std::vector<CutPolygon>& parts)
    {
        for (const CutPolygon& part : parts)
            for (std::size_t i = 0; i < part.vertices.size(); ++i)
                if (part.edges[i].source != edge_internal)
                    from_.insert({place_of(part.vertices[i]),
                                  {{part.vertices[i], part.vertices[next(i, part.vertices.size())], part.edges[i]}}});
    }

    /// All rings. Where the block touches itself, a ring goes on along the rock between its edges.
    [[nodiscard]] std::vector<std::vector<OutlineEdge>> rings()
    {
        std::vector<std::vector<OutlineEdge>> rings;
        for (auto& [place, first] : from_)
        {
            if (first.is_used)
                continue;
            rings.emplace_back();
            for (Edge* edge = &first; edge != nullptr && !edge->is_used; edge = after(edge->edge))
            {
                edge->is_used = true;
                rings.back().push_back(edge->edge);
            }
        }
        return rings;
    }

    /// Does the block touch itself here?
    [[nodiscard]] bool is_shared(const Vec2& p) const { return from_.count(place_of(p)) > 1; }

  private:
    struct Edge
    {
        OutlineEdge edge;
        bool is_used = false;
    };

    /// Of the edges that begin where `edge` ends, the first one clockwise from it: the rock lies on the left of both.
    Edge* after(const OutlineEdge& edge)
    {
        const auto [first, last] = from_.equal_range(place_of(edge.to));
        const Vec2 back = edge.from - edge.to;
        const auto turn = [&](const OutlineEdge& e)  // clockwise from `back`, in (0, 360) degrees
        {
            const Vec2 way = e.to - e.from;
            const double angle = std::atan2(cross(way, back), way.dot(back));
            return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
        };
        Edge* best = nullptr;
        for (auto at = first; at != last; ++at)
            if (best == nullptr || turn(at->second.edge) < turn(best->edge))
                best = &at->second;
        return best;
    }

    std::multimap<Place, Edge> from_;
};

bool goes_on(const OutlineEdge& before, const OutlineEdge& after, double tolerance)
{
    const Vec2 way = after.to - before.from;
    return before.tag == after.tag && before.tag.chord != no_index &&
           std::abs(cross(way, before.to - before.from)) <= tolerance * way.norm() && (before.to - before.from).dot(way) > 0.0;
}

std::vector<OutlineEdge> straightened(std::vector<OutlineEdge> ring, const OuterEdges& edges, double tolerance)
{
    const auto is_one_side = [&](const OutlineEdge& before, const OutlineEdge& after)
    { return !edges.is_shared(after.from) && goes_on(before, after, tolerance); };
    // Begin where a corner is, so that no straight side lies across the end of the list.
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (!is_one_side(ring[previous(i, ring.size())], ring[i]))
        {
            std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i), ring.end());
            break;
        }
    std::vector<OutlineEdge> out;
    for (const OutlineEdge& edge : ring)
        if (!out.empty() && is_one_side(out.back(), edge))
            out.back().to = edge.to;
        else
            out.push_back(edge);
    return out;
}

CutPolygon polygon_of(const std::vector<OutlineEdge>& ring)
{
    CutPolygon polygon;
    for (const OutlineEdge& edge : ring)
        polygon.add(edge.from, edge.tag);
    return polygon;
}

/// The outline as one polygon. Holes are joined to it by internal edges.
std::optional<CutPolygon> single_polygon(const std::vector<CutPolygon>& parts, double tolerance)
{
    std::optional<CutPolygon> outside;
    std::vector<CutPolygon> holes;
    OuterEdges edges(parts);
    for (std::vector<OutlineEdge>& ring : edges.rings())
    {
        const bool is_simple = std::ranges::none_of(ring, [&](const OutlineEdge& e) { return edges.is_shared(e.from); });
        std::vector<CutPolygon> polygon{polygon_of(straightened(std::move(ring), edges, tolerance))};
        if (is_simple)
            drop_straight_vertices(polygon, tolerance);
        if (signed_area(polygon.front().vertices) < 0.0)
            holes.push_back(std::move(polygon.front()));
        else if (outside)
            return std::nullopt;
        else
            outside = std::move(polygon.front());
    }
    if (!outside)
        return std::nullopt;
    return join_holes(std::move(*outside), std::move(holes));
}

double area_of(const std::vector<CutPolygon>& parts)
{
    double sum = 0.0;
    for (const CutPolygon& part : parts)
        sum += signed_area(part.vertices);
    return sum;
}

/// Round-off may leave an outline that crosses itself.
bool are_sound(const std::vector<CutPolygon>& parts, double area)
{
    const auto is_sound = [](const CutPolygon& part) { return signed_area(part.vertices) > 0.0 && is_convex(part.vertices, 1e-9); };
    return std::ranges::all_of(parts, is_sound) && std::abs(area_of(parts) - area) <= 1e-6 * area;
}
}  // namespace

std::vector<std::vector<OutlineEdge>> outline_of(const std::vector<CutPolygon>& parts, double tolerance)
{
    OuterEdges edges(parts);
    std::vector<std::vector<OutlineEdge>> rings = edges.rings();
    for (std::vector<OutlineEdge>& ring : rings)
        ring = straightened(std::move(ring), edges, tolerance);
    return rings;
}

void make_sides_whole(std::vector<CutPolygon>& parts, double tolerance)
{
    if (parts.size() > 1)
        if (const std::optional<CutPolygon> whole = single_polygon(parts, tolerance))
            if (std::vector<CutPolygon> anew = convex_parts(*whole); are_sound(anew, area_of(parts)))
            {
                parts = std::move(anew);
                return;
            }
    merge_convex_parts(parts, tolerance);
    drop_straight_vertices(parts, tolerance);
}
}  // namespace hdem
