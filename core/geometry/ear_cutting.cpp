#include "core/geometry/ear_cutting.h"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/algorithms/equals.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
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
}  // namespace

std::vector<CutPolygon> cut_ears(const CutPolygon& polygon)
{
    Remainder rest(polygon);
    std::vector<CutPolygon> triangles;
    triangles.reserve(polygon.vertices.size());
    for (std::size_t left = polygon.vertices.size(); left > 3; --left)
        triangles.push_back(rest.cut(rest.take_ear()));
    triangles.push_back(rest.last_triangle());
    return triangles;
}
}  // namespace hdem
