#include "core/rock/generated_blocks.h"

#include "core/model/edge_sources.h"
#include "core/rock/block_outline.h"
#include "core/rock/rock_checks.h"
#include "core/rock/side_walls.h"
#include "core/rock/split_sides.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace hdem
{
namespace
{
RockBlock finished(CutBlock& from, const DomainOutline& domain)
{
    RockBlock block;
    block.excavation = from.excavation;
    bool is_fixed = false;
    for (CutPolygon& part : from.parts)
    {
        ConvexPart out{std::move(part.vertices), {}};
        out.vertices.shrink_to_fit();
        out.source.reserve(part.edges.size());
        for (std::size_t i = 0; i < part.edges.size(); ++i)
        {
            const EdgeTag& edge = part.edges[i];
            out.source.push_back(edge.source);
            for (std::size_t side = 0; edge.source == edge_plain && side < domain.boundary_edges.size(); ++side)
            {
                if (domain.boundary_edges[side].count(edge.chord) > 0)
                {
                    block.sides.push_back({static_cast<Index>(side), out.vertices[i], out.vertices[next(i, out.vertices.size())]});
                }
            }
            is_fixed = is_fixed || (edge.source == edge_plain && domain.fixed_edges.count(edge.chord) > 0);
        }
        block.parts.push_back(std::move(out));
    }
    block.fix_x = block.fix_y = block.fix_rotation = is_fixed;
    return block;
}
}  // namespace

DomainOutline outline_of_domain(const CaseDef& def)
{
    DomainOutline domain{domain_polygon(def.domain), {}, {}};
    const bool reversed = make_anticlockwise(domain.polygon);
    domain.fixed_edges = edges_of(domain.polygon, reversed, def.domain.fixed, def.domain.fixed_edges);
    for (const BoundaryDef& boundary : def.boundaries)
    {
        const std::vector<std::string> sides(boundary.side.empty() ? 0 : 1, boundary.side);
        domain.boundary_edges.push_back(edges_of(domain.polygon, reversed, sides, boundary.edges));
    }
    return domain;
}

void add_generated_blocks(const CaseDef& def, const DomainOutline& domain, const Regions& regions, CutMass& mass, RockMass& rock)
{
    struct Place
    {
        Index excavation;
        Vec2 centroid;
        std::size_t block;
    };
    std::vector<RockBlock> blocks;
    std::vector<Place> places;
    blocks.reserve(mass.blocks.size());
    places.reserve(mass.blocks.size());
    for (CutBlock& from : mass.blocks)
    {
        const std::string& material = regions.material(from);
        make_sides_whole(from.parts, mass.tolerance);
        split_sides(from.parts, mass.tolerance);
        blocks.push_back(finished(from, domain));
        blocks.back().material = material;
        places.push_back({from.excavation, moments(blocks.back()).centroid, blocks.size() - 1});
        from = {};  // a million of them need not wait
    }
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b)
              {
                  return std::tie(a.excavation, a.centroid.y(), a.centroid.x(), a.block) <
                         std::tie(b.excavation, b.centroid.y(), b.centroid.x(), b.block);
              });
    rock.blocks.reserve(mass.blocks.size() + def.blocks.size());
    std::vector<std::size_t> inside(def.excavations.size(), 0);
    for (const Place& place : places)
    {
        RockBlock& block = blocks[place.block];
        if (block.excavation == no_index)
        {
            block.name = "b" + std::to_string(rock.blocks.size() + 1);
        }
        else
        {
            const auto number = static_cast<std::size_t>(block.excavation);
            const ExcavationDef& excavation = def.excavations[number];
            block.name = excavation.inside == InsideOutline::one_block ? excavation.name
                                                                       : excavation.name + "." + std::to_string(++inside[number]);
        }
        rock.blocks.push_back(std::move(block));
    }
}

void check_block_names(const CaseDef& def, const RockMass& rock)
{
    const auto is_whole = [](const ExcavationDef& excavation) { return excavation.inside == InsideOutline::one_block; };
    if (std::ranges::none_of(def.excavations, is_whole))
    {
        return;
    }
    std::unordered_set<std::string> names;
    for (const RockBlock& block : rock.blocks)
    {
        if (!names.insert(block.name).second)
        {
            const auto excavation = std::ranges::find(def.excavations, block.name, &ExcavationDef::name);
            throw InputError(Problem{.key = "excavation[" + std::to_string(excavation - def.excavations.begin()) + "].name",
                                     .text = "excavation: name = \"" + block.name +
                                             "\" (a block cut from the domain is called so, too). Choose another."});
        }
    }
}
}  // namespace hdem
