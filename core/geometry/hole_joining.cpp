#include "core/geometry/hole_joining.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

namespace hdem
{
namespace
{
/// Does the way from a to b meet an edge of the polygon at another place than its ends, or run along one?
bool is_blocked(const CutPolygon& polygon, const Vec2& a, const Vec2& b)
{
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i)
    {
        const Vec2 &p = polygon.vertices[i], &q = polygon.vertices[next(i, polygon.vertices.size())];
        const bool has_end = p == a || p == b || q == a || q == b;
        if ((p == a && q == b) || (p == b && q == a))
            return true;
        const double of_p = cross(b - a, p - a), of_q = cross(b - a, q - a), of_a = cross(q - p, a - p), of_b = cross(q - p, b - p);
        if (!has_end && (of_p > 0.0) != (of_q > 0.0) && (of_a > 0.0) != (of_b > 0.0))
            return true;
        const double t = (p - a).dot(b - a);
        if (p != a && p != b && std::abs(of_p) <= 1e-9 * (b - a).squaredNorm() && t > 0.0 && t < (b - a).squaredNorm())
            return true;
    }
    return false;
}

/// Does a way from vertex i lead into the rock beside it, which lies on the left of the polygon's edges?
bool leads_inside(const CutPolygon& polygon, std::size_t i, const Vec2& way)
{
    const std::size_t n = polygon.vertices.size();
    const Vec2 out = polygon.vertices[next(i, n)] - polygon.vertices[i],
               back = polygon.vertices[previous(i, n)] - polygon.vertices[i];
    return cross(out, back) > 0.0 ? cross(out, way) > 0.0 && cross(way, back) > 0.0
                                  : cross(back, way) < 0.0 || cross(way, out) < 0.0;
}

/// The same for all vertices at a place: one of them, if there are any.
bool may_lead_from(const CutPolygon& polygon, const Vec2& place, const Vec2& way)
{
    bool any = false;
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i)
    {
        if (polygon.vertices[i] != place)
            continue;
        if (leads_inside(polygon, i, way))
            return true;
        any = true;
    }
    return !any;
}

/// The vertices of a polygon from vertex k on around, and that one once more.
void add_around(const CutPolygon& polygon, std::size_t k, const EdgeTag& last, CutPolygon& out)
{
    for (std::size_t i = 0, n = polygon.vertices.size(); i < n; ++i)
        out.add(polygon.vertices[(k + i) % n], polygon.edges[(k + i) % n]);
    out.add(polygon.vertices[k], last);
}

/// @return  false: there is none
bool join_hole(CutPolygon& outside, const CutPolygon& hole, const std::vector<CutPolygon>& others)
{
    std::vector<std::tuple<double, std::size_t, std::size_t>> ways;  // a heap, the shortest on top: one of the first few is free
    for (std::size_t i = 0; i < outside.vertices.size(); ++i)
        for (std::size_t j = 0; j < hole.vertices.size(); ++j)
            ways.emplace_back((hole.vertices[j] - outside.vertices[i]).squaredNorm(), i, j);
    std::ranges::make_heap(ways, std::greater<>());
    for (; !ways.empty(); ways.pop_back())
    {
        std::ranges::pop_heap(ways, std::greater<>());
        const auto [length2, i, j] = ways.back();
        const Vec2 &a = outside.vertices[i], &b = hole.vertices[j];
        const auto blocks = [&](const CutPolygon& polygon)
        { return is_blocked(polygon, a, b) || !may_lead_from(polygon, a, b - a) || !may_lead_from(polygon, b, a - b); };
        if (!leads_inside(outside, i, b - a) || !leads_inside(hole, j, a - b) || blocks(outside) || blocks(hole) ||
            std::ranges::any_of(others, blocks))
            continue;
        const EdgeTag internal{edge_internal, no_index};
        CutPolygon joined;
        for (std::size_t k = 0; k < i; ++k)
            joined.add(outside.vertices[k], outside.edges[k]);
        joined.add(outside.vertices[i], internal);
        add_around(hole, j, internal, joined);
        for (std::size_t k = i; k < outside.vertices.size(); ++k)
            joined.add(outside.vertices[k], outside.edges[k]);
        outside = std::move(joined);
        return true;
    }
    return false;
}
}  // namespace

std::optional<CutPolygon> join_holes(CutPolygon outside, std::vector<CutPolygon> holes)
{
    const auto place = [](const CutPolygon& hole) { return std::pair(hole.vertices.front().x(), hole.vertices.front().y()); };
    std::ranges::sort(holes, {}, place);
    while (!holes.empty())
    {
        const CutPolygon hole = std::move(holes.back());
        holes.pop_back();
        if (!join_hole(outside, hole, holes))
            return std::nullopt;
    }
    return outside;
}
}  // namespace hdem
