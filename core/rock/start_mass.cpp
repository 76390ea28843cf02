#include "core/rock/start_mass.h"

#include "core/model/edge_sources.h"
#include "core/rock/fault_lines.h"
#include "core/rock/problem_text.h"
#include "core/rock/short_edges.h"
#include "core/rock/slivers.h"
#include "core/rock/trace_cells.h"

#include <algorithm>
#include <limits>

namespace hdem
{
namespace
{
/// Distance below which a line goes through a vertex: far below the least size of a block, far above the round-off of coordinates.
double snapping_distance(const CaseDef& def, const Box& box)
{
    double size = (box.high - box.low).norm();
    const double largest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    for (const JointSetDef& set : def.joint_sets)
    {
        size = set.spacing > 0.0 ? std::min(size, set.spacing) : size;
    }
    return std::max(1e-9 * size, 64.0 * std::numeric_limits<double>::epsilon() * largest);
}

std::string source_key(const CaseDef& def, std::size_t source)
{
    return source < def.faults.size() ? "fault[" + std::to_string(source) + "].points"
                                      : "region[" + std::to_string(source - def.faults.size()) + "].polygon";
}

/// Warn of parts of faults and outlines that separate nothing: they were not cut.
void warn_of_dropped(const CaseDef& def, RockMass& rock)
{
    const std::vector<double>& dropped = def.trace_cells.dropped;
    for (std::size_t source = 0; source < std::min(dropped.size(), def.faults.size() + def.regions.size()); ++source)
    {
        if (dropped[source] <= 0.0)
        {
            continue;
        }
        const bool is_fault = source < def.faults.size();
        const std::string object = is_fault ? "fault \"" + def.faults[source].name + "\": points"
                                            : "region \"" + def.regions[source - def.faults.size()].name + "\": polygon";
        rock.warnings.push_back({Problem::Severity::warning, source_key(def, source),
                                 object + " (" + text(dropped[source]) +
                                     " m end inside a block and part nothing: they are dropped). Let it end at the domain's "
                                     "boundary or at another fault where this length counts."});
    }
}

/// Lines that run almost along each other leave slivers that no time step is short enough for.
void refuse_slivers(const CaseDef& def, const CutMass& mass, const Polygon& domain)
{
    const double slack = line_slack(domain);
    for (const CutBlock& block : mass.blocks)
    {
        double around = 0.0;
        for (const CutPolygon& part : block.parts)
        {
            for (std::size_t i = 0; i < part.vertices.size(); ++i)
            {
                around += (part.vertices[next(i, part.vertices.size())] - part.vertices[i]).norm();
            }
        }
        if (total_area(block.parts) < slack * around)
        {
            throw InputError(Problem{.key = def.faults.empty() ? "region" : "fault",
                                     .text = "rock mass: a sliver of " + text(total_area(block.parts)) + " m2 at " +
                                             text(block.parts.front().vertices.front()) +
                                             " (faults, outlines of regions or traces run almost along each other there). Give "
                                             "them the same points, or more distance."});
        }
    }
}
/// Cells are joined that are too small; what was drawn, dropped and joined is noted by set.
void note_sets(const CaseDef& def, const Polygon& domain, CutMass& mass, RockMass& rock)
{
    const TraceCells& traces = def.trace_cells;
    const EdgeSources sources(def);
    SmallCells small{.smallest_area = def.generator.smallest_block_area,
                     .narrowest = 2.0 * line_slack(domain),
                     .first_source = sources.set(0),
                     .welded = {}};
    merge_cells(mass, small, rock);
    if (def.generator.smallest_edge > 0.0)
    {
        if (const std::int64_t left = join_at_short_edges(mass, def.generator.smallest_edge, small, rock); left > 0)
        {
            rock.warnings.push_back({Problem::Severity::warning, "generator.smallest_edge",
                                     "generator: smallest_edge = " + text(def.generator.smallest_edge) + " m (" +
                                         std::to_string(left) +
                                         " shorter edges are left where joints of finite length or cells end at others). Expect a "
                                         "small time step, or give longer joints."});
        }
    }
    rock.sets = traces.sets;
    for (std::size_t i = 0; i < rock.sets.size(); ++i)
    {
        const std::int32_t source = i < def.joint_sets.size() ? sources.set(i) : sources.voronoi();
        const auto place = static_cast<std::size_t>(source);
        rock.sets[i].dead_ends = place < traces.dropped.size() ? traces.dropped[place] : 0.0;
        rock.sets[i].welded = small.welded.contains(source) ? small.welded.at(source) : 0.0;
        rock.joints += i < def.joint_sets.size() ? rock.sets[i].joints : 0;
    }
}

/// What is still too small after cells were joined.
void warn_of_small_cells(const CaseDef& def, const CutMass& mass, RockMass& rock)
{
    const auto small = std::count_if(mass.blocks.begin(), mass.blocks.end(),
                                     [&](const CutBlock& block)
                                     { return total_area(block.parts) < def.generator.smallest_block_area; });
    if (small == 0)
    {
        return;
    }
    const bool traced = !def.domain.traces_file.empty();
    const bool has_lines = !def.faults.empty() || !def.regions.empty();
    rock.warnings.push_back({Problem::Severity::warning,
                             traced      ? "domain.traces_file"
                             : has_lines ? source_key(def, 0)
                                         : "generator.smallest_block_area",
                             (traced ? "[domain]: traces_file (" : "faults and regions: (") + std::to_string(small) +
                                 " cells are smaller than generator.smallest_block_area, " +
                                 text(def.generator.smallest_block_area) + " m2). Move these " + (traced ? "traces" : "lines") +
                                 ", or leave some out."});
}
}  // namespace

CutMass start_mass(const CaseDef& def, const Polygon& domain, RockMass& rock)
{
    const TraceCells& traces = def.trace_cells;
    const double tolerance = snapping_distance(def, bounding_box(domain));
    if (traces.cells.empty())
    {
        return uncut_mass(domain, tolerance);
    }
    rock.joints += traces.traces + static_cast<std::int64_t>(def.faults.size());
    rock.dead_ends = traces.dead_ends;
    CutMass mass = traced_mass(domain, traces, EdgeSources(def).traces(), tolerance);
    if (!traces.sets.empty())
    {
        note_sets(def, domain, mass, rock);
    }
    warn_of_small_cells(def, mass, rock);
    if (!def.faults.empty() || !def.regions.empty())
    {
        refuse_slivers(def, mass, domain);
        warn_of_dropped(def, rock);
    }
    return mass;
}
}  // namespace hdem
