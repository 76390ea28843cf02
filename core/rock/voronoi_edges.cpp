#include "core/rock/voronoi_edges.h"

#include "core/model/edge_sources.h"
#include "core/rock/joint_sets.h"
#include "core/rock/line_stretches.h"
#include "core/rock/rock_checks.h"

#include <boost/polygon/voronoi.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace hdem
{
namespace
{
using IntegerPoint = boost::polygon::point_data<std::int32_t>;
using Diagram = boost::polygon::voronoi_diagram<double>;

constexpr double scale = 0x1p30;
constexpr double margin = 6.0;  ///< around the area, in edges: cells there do not know where the points end

/// Vertices and edges that are wholly known.
struct Net
{
    std::vector<Vec2> vertices;  ///< [m]
    std::vector<std::pair<std::size_t, std::size_t>> edges;
};

class CellBuilder
{
  public:
    CellBuilder(const Box& box, const Box& wanted, double edge) : wanted_(wanted)
    {
        box_.low = box.low.array() - margin * edge;
        box_.high = box.high.array() + margin * edge;
        size_ = (box_.high - box_.low).maxCoeff();
    }

    void scatter(std::int64_t count, std::uint64_t seed)
    {
        boost::random::mt19937_64 engine(seed);
        points_.clear();
        const Vec2 size = box_.high - box_.low;
        for (std::int64_t i = 0; i < count; ++i)
        {
            const double x = draw_share(engine), y = draw_share(engine);
            points_.push_back({x * size.x(), y * size.y()});
        }
    }

    void move_to_centroids()
    {
        Diagram diagram;
        build(diagram);
        const Vec2 size = box_.high - box_.low;
        std::vector<Vec2> moved = points_;
        for (const auto& cell : diagram.cells())
        {
            Polygon ring;
            const auto* edge = cell.incident_edge();
            const auto* const first = edge;
            bool is_known = edge != nullptr;
            while (is_known)
            {
                is_known = edge->vertex0() != nullptr;
                if (is_known)
                    ring.push_back(place(*edge->vertex0()) - box_.low);
                is_known = is_known && ring.back().minCoeff() >= 0.0 && (size - ring.back()).minCoeff() >= 0.0;
                edge = edge->next();
                if (edge == first)
                    break;
            }
            if (is_known && ring.size() > 2 && std::abs(signed_area(ring)) > 0.0)
                moved[cell.source_index()] = area_moments(ring).centroid;
        }
        points_ = std::move(moved);
    }

    [[nodiscard]] Net net() const
    {
        Diagram diagram;
        build(diagram);
        Net net;
        for (const auto& vertex : diagram.vertices())
            net.vertices.push_back(place(vertex));
        for (const auto& edge : diagram.edges())
            if (edge.is_finite() && &edge < edge.twin())
                net.edges.emplace_back(edge.vertex0() - diagram.vertices().data(), edge.vertex1() - diagram.vertices().data());
        return net;
    }

    /// Of edges with both ends where they are wanted [m].
    [[nodiscard]] double mean_edge(const Net& net) const
    {
        double sum = 0.0;
        std::int64_t count = 0;
        for (const auto& [a, b] : net.edges)
            if (wanted_.meets({net.vertices[a], net.vertices[a]}) && wanted_.meets({net.vertices[b], net.vertices[b]}))
            {
                sum += (net.vertices[b] - net.vertices[a]).norm();
                ++count;
            }
        return count > 0 ? sum / static_cast<double>(count) : 0.0;
    }

    [[nodiscard]] double area() const { return (box_.high - box_.low).prod(); }

  private:
    void build(Diagram& diagram) const
    {
        std::vector<IntegerPoint> whole;
        whole.reserve(points_.size());
        for (const Vec2& p : points_)
            whole.emplace_back(static_cast<std::int32_t>(std::round(p.x() / size_ * scale)),
                               static_cast<std::int32_t>(std::round(p.y() / size_ * scale)));
        boost::polygon::construct_voronoi(whole.begin(), whole.end(), &diagram);
    }

    template <class Vertex>
    [[nodiscard]] Vec2 place(const Vertex& vertex) const
    {
        return box_.low + Vec2(vertex.x(), vertex.y()) * (size_ / scale);
    }

    Box wanted_;
    Box box_;
    double size_ = 1.0;
    std::vector<Vec2> points_;  ///< from the box's lower left corner [m]
};

/// Edges shorter than `least` shrink to a point, the middle of all vertices that come together.
void drop_short_edges(Net& net, double least)
{
    std::vector<std::size_t> root(net.vertices.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&root](std::size_t v)
    {
        while (root[v] != v)
            v = root[v] = root[root[v]];
        return v;
    };
    std::vector<double> members(net.vertices.size(), 1.0);
    for (bool again = least > 0.0; again;)
    {
        again = false;
        for (const auto& [a, b] : net.edges)
        {
            const std::size_t p = std::min(find(a), find(b)), q = std::max(find(a), find(b));
            if (p == q || (net.vertices[p] - net.vertices[q]).norm() >= least)
                continue;
            net.vertices[p] = (members[p] * net.vertices[p] + members[q] * net.vertices[q]) / (members[p] + members[q]);
            members[p] += members[q];
            root[q] = p;
            again = true;
        }
    }
    std::set<std::pair<std::size_t, std::size_t>> kept;
    for (const auto& [a, b] : net.edges)
        if (find(a) != find(b))
            kept.insert({std::min(find(a), find(b)), std::max(find(a), find(b))});
    net.edges.assign(kept.begin(), kept.end());
}

/// What the cells fill, as a box.
Box area_of(const CaseDef& def)
{
    Box box = bounding_box(domain_polygon(def.domain));
    for (const RegionDef& region : def.regions)
        if (region.name == def.voronoi.region && !region.polygon.empty())
        {
            const Box inner = bounding_box(region.polygon);
            box.low = box.low.cwiseMax(inner.low);
            box.high = box.high.cwiseMin(inner.high).cwiseMax(box.low);
        }
    return box;
}

/// Points a unit area for cells without iterations.
double density_of(double mean_edge)
{
    const double root = 2.0 / (3.0 * mean_edge);
    return root * root;
}
}  // namespace

double count_cells(const CaseDef& def)
{
    const Vec2 size = area_of(def).high - area_of(def).low;
    const double around = 2.0 * margin * def.voronoi.edge;
    return density_of(def.voronoi.edge) * (size.x() + around) * (size.y() + around);
}

std::vector<SourceLine> draw_voronoi(const CaseDef& def, DrawnSet& drawn)
{
    const VoronoiDef& voronoi = def.voronoi;
    Polygon domain = domain_polygon(def.domain);
    make_anticlockwise(domain);
    const Box box = area_of(def);
    JointSetDef as_set;
    as_set.region = voronoi.region;
    as_set.seed = voronoi.seed;
    const std::uint64_t seed = stream_seed(def.generator, as_set, -1, RandomUse::voronoi);
    CellBuilder cells(box, box, voronoi.edge);
    const auto relax = [&](double density)
    {
        cells.scatter(std::max<std::int64_t>(std::llround(density * cells.area()), 4), seed);
        for (int i = 0; i < voronoi.iterations; ++i)
            cells.move_to_centroids();
        return cells.net();
    };
    const double density = density_of(voronoi.edge);
    Net net = relax(density);
    if (const double found = cells.mean_edge(net); voronoi.iterations > 0 && found > 0.0)
        net = relax(density * (found / voronoi.edge) * (found / voronoi.edge));

    drawn.name = "voronoi";
    drawn.trace.expected = voronoi.edge;
    drop_short_edges(net, def.generator.smallest_edge);

    const Regions regions(def, domain);
    std::vector<SourceLine> lines;
    const std::int32_t source = EdgeSources(def).voronoi();
    for (const auto& [a, b] : net.edges)
    {
        const Vec2& from = net.vertices[a];
        const Vec2& to = net.vertices[b];
        if (!box.meets({from.cwiseMin(to), from.cwiseMax(to)}) || from == to)
            continue;
        for (const Stretch& stretch : find_stretches(def, regions, as_set, domain, from, to))
        {
            lines.push_back({source, {stretch.from, stretch.to}});
            drawn.length += stretch.length;
            drawn.joints += stretch.length > 0.0 ? 1 : 0;
            if (stretch.from == from && stretch.to == to && contains(domain, from) && contains(domain, to))
                drawn.trace.add((to - from).norm());
        }
    }
    return lines;
}
}  // namespace hdem
