#include "core/rock/block_outline.h"

#include "core/rock/weld.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hdem
{
namespace
{
bool goes_on(const OutlineEdge& before, const OutlineEdge& after, double tolerance)
{
    const Vec2 way = after.to - before.from;
    return before.tag == after.tag && before.tag.chord != no_index &&
           std::abs(cross(way, before.to - before.from)) <= tolerance * way.norm() && (before.to - before.from).dot(way) > 0.0;
}

std::vector<OutlineEdge> straightened(std::vector<OutlineEdge> ring, double tolerance)
{
    // Begin where a corner is, so that no straight side lies across the end of the list.
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (!goes_on(ring[previous(i, ring.size())], ring[i], tolerance))
        {
            std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i), ring.end());
            break;
        }
    std::vector<OutlineEdge> out;
    for (const OutlineEdge& edge : ring)
        if (!out.empty() && goes_on(out.back(), edge, tolerance))
            out.back().to = edge.to;
        else
            out.push_back(edge);
    return out;
}

/// The outline as one polygon, none where it has holes or touches itself.
std::optional<CutPolygon> single_ring(const std::vector<CutPolygon>& parts, double tolerance)
{
    const std::vector<std::vector<OutlineEdge>> rings = outline_of(parts, tolerance);
    if (rings.size() != 1)
        return std::nullopt;
    CutPolygon ring;
    std::set<std::pair<double, double>> vertices;
    for (const OutlineEdge& edge : rings.front())
    {
        ring.add(edge.from, edge.tag);
        if (!vertices.insert({edge.from.x(), edge.from.y()}).second)
            return std::nullopt;
    }
    return ring;
}
}  // namespace

std::vector<std::vector<OutlineEdge>> outline_of(const std::vector<CutPolygon>& parts, double tolerance)
{
    std::multimap<std::pair<double, double>, OutlineEdge> from;
    for (const CutPolygon& part : parts)
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
            if (part.edges[i].source != edge_internal)
                from.insert({{part.vertices[i].x(), part.vertices[i].y()},
                             {part.vertices[i], part.vertices[next(i, part.vertices.size())], part.edges[i]}});
    std::vector<std::vector<OutlineEdge>> rings;
    while (!from.empty())
    {
        std::vector<OutlineEdge> ring;
        for (auto edge = from.begin(); edge != from.end(); edge = from.find({ring.back().to.x(), ring.back().to.y()}))
        {
            ring.push_back(edge->second);
            from.erase(edge);
        }
        rings.push_back(straightened(std::move(ring), tolerance));
    }
    return rings;
}

void make_sides_whole(std::vector<CutPolygon>& parts, double tolerance)
{
    if (parts.size() > 1)
        if (const std::optional<CutPolygon> ring = single_ring(parts, tolerance))
        {
            std::vector<CutPolygon> whole{*ring};
            drop_straight_vertices(whole, tolerance);
            parts = convex_parts(whole.front());
            return;
        }
    merge_convex_parts(parts, tolerance);
    drop_straight_vertices(parts, tolerance);
}
}  // namespace hdem
