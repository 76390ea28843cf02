#include "core/version.h"
#include "io/digest.h"
#include "tools/hdem/run_figures.h"
#include "tools/hdem/run_report.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace hdem
{
namespace
{
/// As OpenMP counts them: those this process may run on.
int processors_at_hand()
{
    cpu_set_t processors;
    CPU_ZERO(&processors);
    if (::sched_getaffinity(0, sizeof processors, &processors) != 0)
        return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
    return std::max(CPU_COUNT(&processors), 1);
}

std::string origin_of_threads(const RunOptions& options)
{
    if (options.threads)
        return "--threads";
    return std::string("auto: as many as are fastest, up to ") +
           (std::getenv("OMP_NUM_THREADS") != nullptr ? "OMP_NUM_THREADS" : "the processors at hand");
}

/// "spacing 1.21 m (1.2)": what came out, and the mean of the distribution.
std::string drawn_text(const char* name, const DrawnNumber& drawn, const char* unit)
{
    return drawn.count == 0 ? "" : fmt::format(", {} {:.7g}{} ({:.10g})", name, drawn.mean(), unit, drawn.expected);
}
}  // namespace

std::string describe_cuts(const RockMass& rock)
{
    const std::string refused = rock.refused_cuts == 0
                                    ? "none refused"
                                    : fmt::format(
                                          "{} refused (a piece or an edge would be too small; the block stays whole there, a rock "
                                          "bridge across the joint)",
                                          rock.refused_cuts);
    return fmt::format("{} traces, {} dead ends dropped, {} cuts, {}, {} skipped by persistence, {} slivers merged", rock.joints,
                       rock.dead_ends, rock.cuts, refused, rock.skipped_cuts, rock.merged_slivers);
}

std::vector<std::string> describe_sets(const RockMass& rock)
{
    std::vector<std::string> lines;
    for (const DrawnSet& set : rock.sets)
    {
        std::string line = fmt::format("{}: {} {}", printable(set.name), set.joints, set.name == "voronoi" ? "edges" : "joints");
        line += drawn_text("dip", set.dip, " deg");
        line += drawn_text("spacing", set.spacing, " m");
        line += drawn_text(set.name == "voronoi" ? "edge" : "trace", set.trace, " m");
        line += drawn_text("gap", set.gap, " m");
        line += fmt::format(", {:.6g} m in the domain", set.length);
        for (const auto& [length, what] :
             {std::pair(set.skipped, "skipped by persistence"), std::pair(set.refused, "refused"),
              std::pair(set.dead_ends, "dropped as dead ends"), std::pair(set.welded, "welded to join slivers")})
            if (length > 0.0 && set.length > 0.0)
                line += fmt::format(", {:.6g} m ({:.3g} %) {}", length, 100.0 * length / set.length, what);
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> insitu_warnings(const Model& model, const InsituSummary& insitu)
{
    std::vector<std::string> warnings;
    if (insitu.field > 1e-3)
        warnings.push_back(fmt::format("[insitu]: the field is not in equilibrium with gravity (it lacks {:.3g} of rho g). Blocks "
                                       "will move. Give gradient = [.., rho g, ..], or surface and ratio.",
                                       insitu.field));
    if (insitu.unbalance > 1e-9)
        warnings.push_back(
            fmt::format("[insitu]: block {} is out of balance by {:.3g} of what acts on it. Look for a side that is "
                        "free under stress (fix it), for a gap beside the block, or for a joint that would bear tension.",
                        printable(model.name[insitu.worst]), insitu.unbalance));
    Index above = 0;
    double length = 0.0;
    for (const StressedSet& set : insitu.sets)
    {
        above += set.above;
        length += set.length_above;
    }
    if (above > 0)
        warnings.push_back(
            fmt::format("[insitu]: {} joints ({:.4g} m) bear more shear than their strength, or tension, which they do "
                        "not take. They slip or open in the first cycle. `hdem check` lists them set by set.",
                        above, length));
    return warnings;
}

void print_banner(Log& log, const RunStart& start, const RunOptions& options, Simulation& simulation)
{
    const Model& model = simulation.model();
    const State& state = simulation.state();
    log.line(std::string(version_line()));
    log.line(fmt::format("case      {} (SHA-256 {:.12}...){}", start.record.case_file, sha256_hex(start.record.case_text),
                         model.title.empty() ? "" : fmt::format(": {}", model.title)));
    for (const std::string& note : start.notes)
        log.line(note);
    log.line(fmt::format("blocks    {}, of which {} free; smallest free one {:.4g} kg", present_blocks(state), free_blocks(state),
                         smallest_free_mass(model, state)));
    const RockMass& rock = start.loaded.setup.rock;
    if (rock.joints > 0)
        log.line("joints    " + describe_cuts(rock));
    for (const std::string& line : describe_sets(rock))
        log.line("          " + line);
    log.line(fmt::format("contacts  {} pairs of faces near each other, {} closed points", state.contacts.size(),
                         simulation.count_contacts().closed()));
    log.line(fmt::format("method    {}; threshold scale {:.4g}", name_of(state.method), model.threshold_scale));
    log.line(fmt::format("threads   {}{} ({})", !options.threads && simulation.threads() > 1 ? "1 to " : "", simulation.threads(),
                         origin_of_threads(options)));
    const bool is_shortened = model.time_step == model.default_time_step && model.time_step < model.paper_time_step;
    log.line(fmt::format("time step {:.4g} s{}; Eq. (32) {:.4g} s, stable limit of the present contacts {:.4g} s", model.time_step,
                         is_shortened ? " (shorter for sides above 4 m)" : "", model.paper_time_step, simulation.critical_step()));
    log.line(fmt::format("memory    {:.0f} MB", peak_megabytes()));
    if (const int processors = processors_at_hand(); simulation.threads() > processors)
        log.line(fmt::format(
            "warning: threads = {} (more than the {} processors at hand: they wait for each other, which is slow). Give "
            "--threads {}.",
            simulation.threads(), processors, processors));
    for (const Problem& warning : start.loaded.warnings)
        log.line(warning.text);
    for (const std::string& warning : start.record.warnings)
        log.line("warning: " + warning);
}
}  // namespace hdem
