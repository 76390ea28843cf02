#include "core/rock/rock_mass.h"

#include "core/model/edge_sources.h"
#include "core/rock/block_cutter.h"
#include "core/rock/excavation.h"
#include "core/rock/explicit_blocks.h"
#include "core/rock/finite_traces.h"
#include "core/rock/generated_blocks.h"
#include "core/rock/joint_sets.h"
#include "core/rock/line_stretches.h"
#include "core/rock/problem_text.h"
#include "core/rock/regions.h"
#include "core/rock/rock_checks.h"
#include "core/rock/rock_warnings.h"
#include "core/rock/side_walls.h"
#include "core/rock/slivers.h"
#include "core/rock/start_mass.h"
#include "core/rock/weld.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hdem
{
namespace
{
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
    DomainOutline domain;
    if (def.domain.given)
    {
        domain = outline_of_domain(def);
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
        add_generated_blocks(def, domain, regions, mass, rock);
        check_area(rock);
        check_block_names(def, rock);
        warn_of_small_blocks(def, rock);
    }
    const double mean_size = std::sqrt(rock.domain_area / static_cast<double>(std::max<std::size_t>(rock.blocks.size(), 1)));
    add_explicit_blocks(def, rock);
    add_walls(def, domain.polygon, domain.boundary_edges, mean_size, rock);
    return rock;
}
}  // namespace hdem
