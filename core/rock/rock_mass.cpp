#include "core/rock/rock_mass.h"

#include "core/model/edge_sources.h"
#include "core/rock/block_cutter.h"
#include "core/rock/block_outline.h"
#include "core/rock/excavation.h"
#include "core/rock/explicit_blocks.h"
#include "core/rock/finite_traces.h"
#include "core/rock/joint_sets.h"
#include "core/rock/line_stretches.h"
#include "core/rock/problem_text.h"
#include "core/rock/regions.h"
#include "core/rock/rock_checks.h"
#include "core/rock/rock_warnings.h"
#include "core/rock/side_walls.h"
#include "core/rock/slivers.h"
#include "core/rock/split_sides.h"
#include "core/rock/start_mass.h"
#include "core/rock/weld.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace hdem
{
namespace
{
/// The domain, anticlockwise, and which of its edges hold blocks fast.
struct Domain
{
    Polygon polygon;
    std::set<Index> fixed_edges;
    std::vector<std::set<Index>> boundary_edges;  ///< per [[boundary]]
};

Domain make_domain(const CaseDef& def)
{
    Domain domain{domain_polygon(def.domain), {}, {}};
    const bool reversed = make_anticlockwise(domain.polygon);
    domain.fixed_edges = edges_of(domain.polygon, reversed, def.domain.fixed, def.domain.fixed_edges);
    for (const BoundaryDef& boundary : def.boundaries)
    {
        const std::vector<std::string> sides(boundary.side.empty() ? 0 : 1, boundary.side);
        domain.boundary_edges.push_back(edges_of(domain.polygon, reversed, sides, boundary.edges));
    }
    return domain;
}

/// What was drawn of a through-going set.
DrawnSet noted(const JointSetDef& set, const JointTraces& joints, const Polygon& domain, double tolerance)
{
    DrawnSet drawn;
    drawn.name = set.name;
    drawn.dip.expected = set.dip_law.is_random() ? Distribution(dip_within_reach(set)).mean() : set.dip_deg;
    drawn.spacing.expected = set.spacing_law.is_random() ? Distribution(set.spacing_law).mean() : set.spacing;
    std::optional<double> before;
    const Box box = bounding_box(domain);
    const double far = (box.high - box.low).norm();
    for (std::size_t i = 0; i < joints.lines.size(); ++i)
    {
        const CutLine& line = joints.lines[i];
        if (side_of(domain, line, tolerance) != Side::crossed)
        {
            before.reset();
            continue;
        }
        const double at = joints.across.dot(line.point - joints.origin);
        const double reach = far + (line.point - box.low).norm();
        ++drawn.joints;
        drawn.dip.add(joints.dips[i]);
        drawn.length += length_inside(domain, line.point - reach * line.direction, line.point + reach * line.direction);
        if (before)
        {
            drawn.spacing.add(at - *before);
        }
        before = at;
    }
    return drawn;
}

void cut_joint_sets(const CaseDef& def, const Polygon& domain, const Regions& regions, CutMass& mass, RockMass& rock)
{
    rock.sets.resize(std::max(rock.sets.size(), def.joint_sets.size()));
    for (std::size_t i = 0; i < def.joint_sets.size(); ++i)
    {
        const JointSetDef& set = def.joint_sets[i];
        if (is_cut_as_lines(def, set))
        {
            warn_of_no_joints(set, i, rock.sets[i].joints, rock);
            continue;
        }
        JointTraces joints = draw_joints(set, static_cast<std::int32_t>(i), def.generator, bounding_box(domain));
        joints.source = EdgeSources(def).set(i);
        rock.sets[i] = noted(set, joints, domain, mass.tolerance);
        const std::int64_t crossing = rock.sets[i].joints;
        rock.joints += crossing;
        warn_of_no_joints(set, i, crossing, rock);
        const std::int64_t cuts = rock.cuts, refused = rock.refused_cuts;
        const std::int64_t before = cuts + refused + rock.skipped_cuts;
        const bool is_limited = !set.region.empty() || !set.outside.empty();
        std::function<bool(const CutBlock&)> is_meant;
        if (is_limited)
        {
            is_meant = [&](const CutBlock& block) { return regions.is_meant(set, block); };
        }
        const CutLengths lengths = cut_blocks(mass, joints, set, def.generator, rock, is_meant);
        rock.sets[i].skipped = lengths.skipped;
        rock.sets[i].refused = lengths.refused;
        if (is_limited)
        {
            rock.sets[i].length = lengths.sum();
        }
        warn_of_refused_cuts(set, i, rock.refused_cuts - refused, rock.cuts - cuts, rock);
        if (is_limited && crossing > 0 && rock.cuts + rock.refused_cuts + rock.skipped_cuts == before)
        {
            rock.warnings.push_back(
                {Problem::Severity::warning, "joint_set[" + std::to_string(i) + "]",
                 "joint set \"" + set.name + "\": no joint crosses " +
                     (set.region.empty() ? "the rock outside \"" + set.outside + "\"" : "region \"" + set.region + "\"") +
                     ". Check its spacing and origin."});
        }
    }
}

void cut_excavations(const CaseDef& def, CutMass& mass, RockMass& rock)
{
    std::vector<Problem> problems;
    std::vector<Polygon> outlines;
    for (std::size_t i = 0; i < def.excavations.size(); ++i)
    {
        const ExcavationDef& excavation = def.excavations[i];
        outlines.push_back(outline_polygon(excavation));
        const std::size_t areas = cut_outline(mass, outlines, i, excavation.inside);
        const std::string key = "excavation[" + std::to_string(i) + "]";
        const std::string object = "excavation \"" + excavation.name + "\": ";
        if (areas == 0)
        {
            problems.push_back({Problem::Severity::error, key,
                                object + "nothing is left inside the outline (it is too small to be cut, or lies in earlier "
                                         "excavations). Move it, or drop it."});
        }
        else if (areas > 1 && excavation.inside == InsideOutline::one_block)
        {
            problems.push_back(
                {Problem::Severity::error, key + ".inside",
                 object + "the domain and earlier excavations leave " + std::to_string(areas) +
                     " separate areas inside the outline (one block must hang together). Give inside = \"jointed\"."});
        }
    }
    if (!problems.empty())
    {
        throw InputError(std::move(problems));
    }
    warn_of_overlaps(def, outlines, rock);
    merge_slivers(mass, def.generator.smallest_block_area, EdgeSources(def).set(0), rock);
    weld_vertices(mass, outlines);
}

RockBlock finished(CutBlock& from, const Domain& domain)
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

/// Blocks in order of their excavation (none first), then from the bottom up by their centroids, then from the left; names count them.
void add_generated(const CaseDef& def, const Domain& domain, const Regions& regions, CutMass& mass, RockMass& rock)
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

/// A block that is the whole inside of an excavation is called as the user wants: others may have that name already.
void check_names(const CaseDef& def, const RockMass& rock)
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

}  // namespace

AreaMoments moments(const RockBlock& block)
{
    std::vector<AreaMoments> parts;
    parts.reserve(block.parts.size());
    for (const ConvexPart& part : block.parts)
    {
        parts.push_back(area_moments(part.vertices));
    }
    return combined(parts);
}

double area(const RockBlock& block)
{
    double sum = 0.0;
    for (const ConvexPart& part : block.parts)
    {
        sum += signed_area(part.vertices);
    }
    return sum;
}

RockMass generate_rock_mass(const CaseDef& def)
{
    std::vector<Problem> problems = find_rock_problems(def);
    if (!problems.empty())
    {
        throw InputError(std::move(problems));
    }
    RockMass rock;
    Domain domain;
    if (def.domain.given)
    {
        domain = make_domain(def);
        rock.domain_area = signed_area(domain.polygon);
        CutMass mass = start_mass(def, domain.polygon, rock);
        const Regions regions(def, domain.polygon);
        problems = regions.find_problems(mass);
        if (!problems.empty())
        {
            throw InputError(std::move(problems));
        }
        warn_of_large_cells(def, domain.polygon, rock);
        cut_joint_sets(def, domain.polygon, regions, mass, rock);
        if (def.trace_cells.traces > 0)
        {
            rock.sets.emplace_back();
            rock.sets.back().name = "traces";
            rock.sets.back().joints = def.trace_cells.traces;
            rock.sets.back().length = def.trace_cells.trace_length;
            rock.sets.back().dead_ends = def.trace_cells.trace_dropped;
        }
        cut_excavations(def, mass, rock);
        add_generated(def, domain, regions, mass, rock);
        check_area(rock);
        check_names(def, rock);
        warn_of_small_blocks(def, rock);
    }
    const double mean_size = std::sqrt(rock.domain_area / static_cast<double>(std::max<std::size_t>(rock.blocks.size(), 1)));
    add_explicit_blocks(def, rock);
    add_walls(def, domain.polygon, domain.boundary_edges, mean_size, rock);
    return rock;
}
}  // namespace hdem
