#include "io/block_shapes.h"

#include "core/model/edge_sources.h"

#include <algorithm>
#include <map>

namespace hdem
{
namespace
{
struct OuterEdge
{
    Vec2 from;
    Vec2 to;
    std::int32_t source;
};

/// What an edge was cut by.
std::string name_of(const CaseDef& def, std::int32_t source)
{
    if (source < 0)
        return source == edge_plain ? "domain" : source == edge_outline ? "excavation" : "other";
    const EdgeSources sources(def);
    const auto number = static_cast<std::size_t>(source);
    if (number < def.faults.size())
        return "fault " + def.faults[number].name;
    if (source < sources.region(def.regions.size()))
        return "outline of " + def.regions[number - def.faults.size()].name;
    if (source < sources.traces())
        return def.joint_sets[number - def.faults.size() - def.regions.size()].name;
    return source == sources.traces() ? "traces" : "voronoi";
}

/// Outer edges one after another, ring by ring.
std::vector<std::vector<OuterEdge>> rings_of(const RockBlock& block)
{
    std::multimap<std::pair<double, double>, OuterEdge> from;
    for (const ConvexPart& part : block.parts)
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
            if (part.source[i] != edge_internal)
            {
                const Vec2& a = part.vertices[i];
                from.insert({{a.x(), a.y()}, {a, part.vertices[next(i, part.vertices.size())], part.source[i]}});
            }
    std::vector<std::vector<OuterEdge>> rings;
    while (!from.empty())
    {
        std::vector<OuterEdge>& ring = rings.emplace_back();
        auto edge = from.begin();
        while (edge != from.end())
        {
            ring.push_back(edge->second);
            from.erase(edge);
            edge = from.find({ring.back().to.x(), ring.back().to.y()});
        }
    }
    return rings;
}

Polygon points_of(const std::vector<OuterEdge>& ring)
{
    Polygon points;
    for (const OuterEdge& edge : ring)
        points.push_back(edge.from);
    return points;
}
}  // namespace

std::vector<BlockShape> block_shapes(const CaseDef& def, const RockMass& rock)
{
    std::vector<BlockShape> shapes;
    for (std::size_t b = 0; b + rock.walls.size() < rock.blocks.size(); ++b)
    {
        const RockBlock& from = rock.blocks[b];
        BlockShape& to = shapes.emplace_back();
        to.block.name = from.name;
        to.block.material = from.material;
        to.block.fix_x = from.fix_x;
        to.block.fix_y = from.fix_y;
        to.block.fix_rotation = from.fix_rotation;
        to.area = area(from);
        to.excavation = from.excavation == no_index ? "" : def.excavations[static_cast<std::size_t>(from.excavation)].name;
        double greatest = 0.0;
        for (const std::vector<OuterEdge>& ring : rings_of(from))
        {
            Polygon points = points_of(ring);
            if (const double size = signed_area(points); size > greatest)
            {
                greatest = size;
                to.block.polygon.swap(points);
                to.edges.clear();
                for (const OuterEdge& edge : ring)
                    to.edges.push_back(name_of(def, edge.source));
            }
            if (points.size() > 2)
                to.holes.push_back(std::move(points));
        }
    }
    return shapes;
}
}  // namespace hdem
