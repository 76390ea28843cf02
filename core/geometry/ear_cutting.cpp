#include "core/geometry/ear_cutting.h"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/algorithms/equals.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace hdem
{
namespace
{
namespace bgi = boost::geometry::index;
using BoostPoint = boost::geometry::model::d2::point_xy<double>;
using BoostBox = boost::geometry::model::box<BoostPoint>;
using Entry = std::pair<BoostPoint, std::size_t>;  // position and number of a vertex
using Tree = bgi::rtree<Entry, bgi::quadratic<8>>;

/// Order of new edges: shortest first; of equal ones the first vertex.
struct Candidate
{
    double length2;
    std::size_t vertex;
    unsigned version;  ///< of the vertex; an older one is out of date

    friend bool operator>(const Candidate& a, const Candidate& b)
    {
        return a.length2 != b.length2 ? a.length2 > b.length2 : a.vertex > b.vertex;
    }
};

/// What is left of a polygon while its ears are cut off: a ring of vertices.
class Remainder
{
  public:
    explicit Remainder(const CutPolygon& polygon) : points_(polygon.vertices), vertex_(polygon.vertices.size())
    {
        const std::size_t n = vertex_.size();
        for (std::size_t k = 0; k < n; ++k)
            vertex_[k] = {.before = previous(k, n), .after = next(k, n), .edge = polygon.edges[k]};
        std::vector<Entry> blocking;
        for (std::size_t k = 0; k < n; ++k)
        {
            vertex_[k].turn = turn_at(k);
            if (!turns_left(k))
                blocking.push_back(entry(k));
            vertex_[k].is_blocking = !turns_left(k);
        }
        blocking_ = Tree(blocking);  // packed
        for (std::size_t k = 0; k < n; ++k)
            offer(k);
    }

    /// The best ear; in a polygon without one (round-off) the sharpest left turn.
    std::size_t take_ear()
    {
        while (!candidates_.empty())
        {
            const Candidate best = candidates_.top();
            candidates_.pop();
            if (best.version != vertex_[best.vertex].version || vertex_[best.vertex].is_cut)
                continue;
            const std::optional<std::size_t> blocking = blocking_vertex(best.vertex);
            if (!blocking)
                return best.vertex;
            vertex_[*blocking].waiting.push_back(best.vertex);
        }
        return sharpest();
    }

    /// Its triangle; the remainder goes on without it.
    CutPolygon cut(std::size_t k)
    {
        const auto [before, after] = std::pair(vertex_[k].before, vertex_[k].after);
        const EdgeTag internal{edge_internal, no_index};
        CutPolygon ear{{points_[before], points_[k], points_[after]}, {vertex_[before].edge, vertex_[k].edge, internal}};
        vertex_[before].edge = internal;
        vertex_[before].after = after;
        vertex_[after].before = before;
        vertex_[k].is_cut = true;
        set_blocking(k, false);
        for (const std::size_t changed : {before, after})
        {
            ++vertex_[changed].version;
            vertex_[changed].turn = turn_at(changed);
            set_blocking(changed, !turns_left(changed));
            offer(changed);
        }
        return ear;
    }

    [[nodiscard]] CutPolygon last_triangle() const
    {
        CutPolygon last;
        for (std::size_t k = 0; k < vertex_.size(); ++k)
            if (!vertex_[k].is_cut)
                last.add(points_[k], vertex_[k].edge);
        return last;
    }

  private:
    struct Vertex
    {
        std::size_t before;
        std::size_t after;
        EdgeTag edge;  ///< to the vertex after it
        double turn = 0.0;
        unsigned version = 0;
        bool is_cut = false;
        bool is_blocking = false;            ///< stands in the tree
        std::vector<std::size_t> waiting{};  ///< candidates that had it in their triangles
    };

    [[nodiscard]] Entry entry(std::size_t k) const { return {{points_[k].x(), points_[k].y()}, k}; }
    [[nodiscard]] bool turns_left(std::size_t k) const { return vertex_[k].turn > straight_sine; }

    [[nodiscard]] double turn_at(std::size_t k) const
    {
        const Vec2 in = points_[k] - points_[vertex_[k].before];
        const Vec2 out = points_[vertex_[k].after] - points_[k];
        return cross(in, out) / (in.norm() * out.norm());
    }

    void offer(std::size_t k)
    {
        if (turns_left(k))
            candidates_.push({(points_[vertex_[k].after] - points_[vertex_[k].before]).squaredNorm(), k, vertex_[k].version});
    }

    void set_blocking(std::size_t k, bool blocks)
    {
        Vertex& v = vertex_[k];
        if (v.is_blocking == blocks)
            return;
        v.is_blocking = blocks;
        if (blocks)
        {
            blocking_.insert(entry(k));
            return;
        }
        blocking_.remove(entry(k));
        for (const std::size_t waiting : std::exchange(v.waiting, {}))
            if (!vertex_[waiting].is_cut)
                offer(waiting);
    }

    /// Does an edge of vertex v, which is at the place of corner c of a triangle, lead into the triangle?
    [[nodiscard]] bool enters(std::size_t v, const Polygon& triangle, std::size_t c) const
    {
        const Vec2 first = triangle[next(c, 3)] - triangle[c], last = triangle[previous(c, 3)] - triangle[c];
        const auto leads_in = [&](std::size_t to)
        {
            const Vec2 way = points_[to] - triangle[c];
            return cross(first, way) > straight_sine * first.norm() * way.norm() &&
                   cross(way, last) > straight_sine * last.norm() * way.norm();
        };
        return leads_in(vertex_[v].before) || leads_in(vertex_[v].after);
    }

    /// A vertex in the closed triangle that cutting off k would take. Where the polygon touches itself, one at the place of a corner counts if its edges lead inside.
    [[nodiscard]] std::optional<std::size_t> blocking_vertex(std::size_t k) const
    {
        const std::array<std::size_t, 3> corners = {vertex_[k].before, k, vertex_[k].after};
        const Polygon corner = {points_[corners[0]], points_[corners[1]], points_[corners[2]]};
        const auto is_inside = [&](const Entry& found)
        {
            bool inside = std::ranges::find(corners, found.second) == corners.end();
            for (std::size_t c = 0; c < 3 && inside; ++c)
            {
                if (points_[found.second] == corner[c])
                    return enters(found.second, corner, c);
                const Vec2 edge = corner[next(c, 3)] - corner[c];
                inside = cross(edge, points_[found.second] - corner[c]) >= -straight_sine * edge.squaredNorm();
            }
            return inside;
        };
        const Box box = bounding_box(corner);
        const Vec2 slack = 10.0 * straight_sine * (box.high - box.low);
        const BoostBox area({box.low.x() - slack.x(), box.low.y() - slack.y()},
                            {box.high.x() + slack.x(), box.high.y() + slack.y()});
        const auto found = blocking_.qbegin(bgi::intersects(area) && bgi::satisfies(is_inside));
        return found == blocking_.qend() ? std::nullopt : std::optional(found->second);
    }

    [[nodiscard]] std::size_t sharpest() const
    {
        std::size_t best = vertex_.size();
        for (std::size_t k = 0; k < vertex_.size(); ++k)
            if (!vertex_[k].is_cut && (best == vertex_.size() || vertex_[k].turn > vertex_[best].turn))
                best = k;
        return best;
    }

    const Polygon& points_;
    std::vector<Vertex> vertex_;
    Tree blocking_;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates_;
};

/// An edge at a place that a polygon passes more than once.
struct EdgeThere
{
    Vec2 way;           ///< along it, away from there
    bool leaves;        ///< the polygon goes on along it; else it arrives
    std::size_t visit;  ///< the vertex

    [[nodiscard]] bool is_upper() const { return way.y() > 0.0 || (way.y() == 0.0 && way.x() > 0.0); }
};

/// Anticlockwise; of two in one direction, as on a way to a hole, the arriving one comes first: what lies before it has been on its left.
bool comes_before(const EdgeThere& a, const EdgeThere& b)
{
    if (a.is_upper() != b.is_upper())
        return a.is_upper();
    const double turn = cross(a.way, b.way);
    return turn != 0.0 ? turn > 0.0 : std::pair(a.leaves, a.visit) < std::pair(b.leaves, b.visit);
}

/// Where the way around a polygon crosses itself in a vertex: lets it go on along the edge beside which the same area lies.
/// @param leaves_at  for the vertex at which it arrives, that from which it goes on
void untangle(const Polygon& polygon, const std::vector<std::size_t>& visits, std::vector<std::size_t>& leaves_at)
{
    const std::size_t n = polygon.size();
    std::vector<EdgeThere> edges;
    for (const std::size_t k : visits)
    {
        edges.push_back({polygon[next(k, n)] - polygon[k], true, k});
        edges.push_back({polygon[previous(k, n)] - polygon[k], false, k});
    }
    std::ranges::sort(edges, comes_before);
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (edges[e].leaves == edges[next(e, edges.size())].leaves)
            return;  // areas on both sides of an edge: round-off
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (edges[e].leaves)
            leaves_at[edges[next(e, edges.size())].visit] = edges[e].visit;
}

/// The polygons that a polygon consists of which touches itself in points.
std::vector<CutPolygon> parts_that_touch(const CutPolygon& polygon)
{
    const std::size_t n = polygon.vertices.size();
    std::vector<std::size_t> order(n), leaves_at(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    leaves_at = order;
    const auto place = [&](std::size_t k) { return std::tuple(polygon.vertices[k].x(), polygon.vertices[k].y(), k); };
    std::ranges::sort(order, {}, place);
    for (auto begin = order.begin(); begin != order.end();)
    {
        const auto is_there = [&](std::size_t k) { return polygon.vertices[k] == polygon.vertices[*begin]; };
        const auto end = std::find_if_not(begin, order.end(), is_there);
        if (end - begin > 1)
            untangle(polygon.vertices, {begin, end}, leaves_at);
        begin = end;
    }
    std::vector<CutPolygon> parts;
    std::vector<bool> is_taken(n, false);
    for (std::size_t first = 0; first < n; ++first)
    {
        if (is_taken[first])
            continue;
        CutPolygon& part = parts.emplace_back();
        for (std::size_t k = first; !is_taken[k]; k = leaves_at[next(k, n)])
        {
            is_taken[k] = true;
            part.add(polygon.vertices[k], polygon.edges[k]);
        }
    }
    return parts;
}
}  // namespace

std::vector<CutPolygon> cut_ears(const CutPolygon& polygon)
{
    std::vector<CutPolygon> triangles;
    triangles.reserve(polygon.vertices.size());
    for (const CutPolygon& part : parts_that_touch(polygon))
    {
        if (part.vertices.size() < 3)
            continue;  // a way there and back
        Remainder rest(part);
        for (std::size_t left = part.vertices.size(); left > 3; --left)
            triangles.push_back(rest.cut(rest.take_ear()));
        triangles.push_back(rest.last_triangle());
    }
    return triangles;
}
}  // namespace hdem
