#include "core/rock/start_mass.h"

#include "core/model/edge_sources.h"
#include "core/rock/fault_lines.h"
#include "core/rock/problem_text.h"
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
        size = std::min(size, set.spacing);
    }
    return std::max(1e-9 * size, 64.0 * std::numeric_limits<double>::epsilon() * largest);
}

std::string source_key(const CaseDef& def, std::size_t source)
{
    return source < def.faults.size() ? "fault[" + std::to_string(source) + "].points"
                                      : "region[" + std::to_string(source - def.faults.size()) + "].polygon";
}

/// What of a fault or an outline parts nothing was not cut.
void warn_of_dropped(const CaseDef& def, RockMass& rock)
{
    const std::vector<double>& dropped = def.trace_cells.dropped;
    for (std::size_t source = 0; source < dropped.size(); ++source)
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
}  // namespace

CutMass start_mass(const CaseDef& def, const Polygon& domain, RockMass& rock)
{
    const TraceCells& traces = def.trace_cells;
    const double tolerance = snapping_distance(def, bounding_box(domain));
    if (traces.cells.empty())
    {
        return uncut_mass(domain, tolerance);
    }
    const auto small = std::count_if(traces.cells.begin(), traces.cells.end(),
                                     [&](const std::vector<Polygon>& cell)
                                     {
                                         double sum = 0.0;
                                         for (const Polygon& piece : cell)
                                             sum += signed_area(piece);
                                         return sum < def.generator.smallest_block_area;
                                     });
    if (small > 0)
    {
        const bool traced = !def.domain.traces_file.empty();
        rock.warnings.push_back({Problem::Severity::warning, traced ? "domain.traces_file" : source_key(def, 0),
                                 (traced ? "[domain]: traces_file (" : "faults and regions: (") + std::to_string(small) +
                                     " cells are smaller than generator.smallest_block_area, " +
                                     text(def.generator.smallest_block_area) + " m2). Move these " + (traced ? "traces" : "lines") +
                                     ", or leave some out."});
    }
    rock.joints += traces.traces + static_cast<std::int64_t>(def.faults.size());
    rock.dead_ends = traces.dead_ends;
    CutMass mass = traced_mass(domain, traces, EdgeSources(def).traces(), tolerance);
    if (!def.faults.empty() || !def.regions.empty())
    {
        refuse_slivers(def, mass, domain);
        warn_of_dropped(def, rock);
    }
    return mass;
}
}  // namespace hdem
