#include "tools/python/outlines.h"

#include "core/geometry/convex_part.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
struct Edge
{
    Vec2 from, to;
};

Vec2 placed(const Model& model, const Vec2& v, const BlockMotion& at)
{
    return model.origin + Vec2(at.x + at.c * v.x() - at.s * v.y(), at.y + at.s * v.x() + at.c * v.y());
}

double doubled_area(const Polygon& ring)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        sum += cross(ring[i], ring[(i + 1) % ring.size()]);
    return sum;
}

/// Edges in the block's own frame that do not lie between two of its parts.
std::vector<Edge> outer_edges(const Shapes& shapes, Index block)
{
    std::vector<Edge> edges;
    for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
        for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
            if (shapes.edge_source[v] != edge_internal)
                edges.push_back({shapes.vertex[v], shapes.vertex[shapes.next_vertex(part, v)]});
    return edges;
}

/// Takes the edges of one ring out of `edges`: each goes on with the one that begins where it ends.
Polygon take_ring(std::vector<Edge>& edges)
{
    Polygon ring{edges.back().from};
    Vec2 end = edges.back().to;
    edges.pop_back();
    while (!edges.empty())
    {
        const auto distance = [&](const Edge& edge) { return (edge.from - end).squaredNorm(); };
        const auto next = std::ranges::min_element(edges, {}, distance);
        if ((ring.front() - end).squaredNorm() <= distance(*next))
            break;
        ring.push_back(next->from);
        end = next->to;
        *next = edges.back();
        edges.pop_back();
    }
    return ring;
}
}  // namespace

Polygon outline_of(const Model& model, Index block, const BlockMotion& at)
{
    std::vector<Edge> edges = outer_edges(model.shapes, block);
    Polygon outer;
    while (!edges.empty())
        if (Polygon ring = take_ring(edges); outer.empty() || doubled_area(ring) > doubled_area(outer))
            outer = std::move(ring);
    for (Vec2& v : outer)
        v = placed(model, v, at);
    return outer;
}

std::vector<Polygon> parts_of(const Model& model, Index block, const BlockMotion& at)
{
    const Shapes& shapes = model.shapes;
    std::vector<Polygon> parts;
    for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
    {
        parts.emplace_back();
        for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
            parts.back().push_back(placed(model, shapes.vertex[v], at));
    }
    return parts;
}
}  // namespace hdem
