#include "io/block_shapes.h"

#include "core/model/edge_sources.h"
#include "core/rock/excavation.h"
#include "io/polygons.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace hdem
{
namespace
{
using Json = nlohmann::ordered_json;

/// "fixed", "x rotation", or "" where nothing is.
std::string fixed_text(const BlockDef& block)
{
    if (block.fix_x && block.fix_y && block.fix_rotation)
        return "fixed";
    std::string text = block.fix_x ? "x" : "";
    for (const auto& [is_fixed, word] : {std::pair(block.fix_y, "y"), std::pair(block.fix_rotation, "rotation")})
        if (is_fixed)
            text += (text.empty() ? "" : " ") + std::string(word);
    return text;
}

Json ring_json(const Polygon& ring)
{
    Json points = Json::array();
    for (std::size_t i = 0; i <= ring.size(); ++i)
        points.push_back({ring[i % ring.size()].x(), ring[i % ring.size()].y()});
    return points;
}
struct OuterEdge
{
    Vec2 from;
    Vec2 to;
    std::int32_t source;
};

/// Names of what cut the edges of a case.
class EdgeNames
{
  public:
    explicit EdgeNames(const CaseDef& def) : def_(def), sources_(def)
    {
        for (const ExcavationDef& excavation : def.excavations)
            outlines_.push_back(outline_polygon(excavation));
    }

    [[nodiscard]] std::string of(const OuterEdge& edge) const
    {
        if (edge.source == edge_plain)
            return def_.domain.given ? "domain" : "block";
        if (edge.source < 0)
            return edge.source == edge_outline ? excavation_of(edge) : "other";
        const auto number = static_cast<std::size_t>(edge.source);
        if (number < def_.faults.size())
            return "fault " + def_.faults[number].name;
        if (edge.source < sources_.region(def_.regions.size()))
            return "outline of " + def_.regions[number - def_.faults.size()].name;
        if (edge.source < sources_.traces())
            return def_.joint_sets[number - def_.faults.size() - def_.regions.size()].name;
        return edge.source == sources_.traces() ? "traces" : "voronoi";
    }

  private:
    /// The excavation with the outline nearest to the middle of the edge.
    [[nodiscard]] std::string excavation_of(const OuterEdge& edge) const
    {
        const Vec2 middle = 0.5 * (edge.from + edge.to);
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < outlines_.size(); ++i)
            if (const double away = std::abs(distance_to_boundary(outlines_[i], middle)); away < least)
            {
                least = away;
                nearest = i;
            }
        return "excavation " + def_.excavations[nearest].name;
    }

    const CaseDef& def_;
    EdgeSources sources_;
    std::vector<Polygon> outlines_;
};

/// Outer edges one after another, ring by ring. No ring meets itself: where one comes back to one of its points, what lies between
/// is a ring of its own, as around a block whose corner touches the outline of the block around it.
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
        std::vector<OuterEdge> ring;
        std::map<std::pair<double, double>, std::size_t> begin;  // of the edge that goes on from a point
        for (auto edge = from.begin(); edge != from.end();)
        {
            begin[edge->first] = ring.size();
            ring.push_back(edge->second);
            from.erase(edge);
            const std::pair<double, double> end{ring.back().to.x(), ring.back().to.y()};
            if (const auto back = begin.find(end); back != begin.end())
            {
                const auto first = ring.begin() + static_cast<std::ptrdiff_t>(back->second);
                for (auto closed = first; closed != ring.end(); ++closed)
                    begin.erase({closed->from.x(), closed->from.y()});
                rings.emplace_back(first, ring.end());
                ring.erase(first, ring.end());
            }
            edge = from.find(end);
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
    const EdgeNames names(def);
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
            std::vector<std::string> edges;
            for (const OuterEdge& edge : ring)
                edges.push_back(names.of(edge));
            if (const double size = signed_area(points); size > greatest)
            {
                greatest = size;
                to.block.polygon.swap(points);
                to.edges.swap(edges);
            }
            if (points.size() > 2)
            {
                to.holes.push_back(std::move(points));
                to.hole_edges.push_back(std::move(edges));
            }
        }
    }
    return shapes;
}

std::string to_geojson(std::span<const BlockShape> blocks)
{
    Json features = Json::array();
    for (const BlockShape& shape : blocks)
    {
        Json rings = Json::array({ring_json(shape.block.polygon)});
        for (const Polygon& hole : shape.holes)
            rings.push_back(ring_json(hole));
        const std::string fixed = fixed_text(shape.block);
        features.push_back({{"type", "Feature"},
                            {"properties",
                             {{"name", shape.block.name},
                              {"material", shape.block.material},
                              {"fixed", fixed.empty() ? Json(false) : Json(fixed)},
                              {"area", shape.area},
                              {"excavation", shape.excavation},
                              {"edges", shape.edges}}},
                            {"geometry", {{"type", "Polygon"}, {"coordinates", std::move(rings)}}}});
        if (!shape.holes.empty())
            features.back()["properties"]["hole_edges"] = shape.hole_edges;
    }
    const Json document = {{"type", "FeatureCollection"}, {"features", std::move(features)}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_wkt(std::span<const BlockShape> blocks)
{
    std::ostringstream out;
    for (const BlockShape& shape : blocks)
    {
        out << "# edges: " << fmt::format("{}", fmt::join(shape.edges, "; ")) << '\n';
        for (const std::vector<std::string>& edges : shape.hole_edges)
            out << "# edges of a hole: " << fmt::format("{}", fmt::join(edges, "; ")) << '\n';
        write_polygon(out, shape.block, shape.holes);
    }
    return out.str();
}
}  // namespace hdem
