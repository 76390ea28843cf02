#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"
#include "tools/hdem/run_figures.h"
#include "tools/hdem/run_report.h"
#include "tools/hdem/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

/// The fastest blocks first: of hundreds only some are named.
std::vector<std::string> fastest_first(std::vector<std::string> names, const Model& model, const Blocks& blocks)
{
    std::unordered_map<std::string, double> speed;
    for (Index b = 0; b < model.blocks(); ++b)
        speed.emplace(model.name[b], rim_speed(b, model, blocks));
    std::ranges::stable_sort(names, std::greater<>(), [&](const std::string& name) { return speed.at(name); });
    return names;
}

std::string words(std::string name)
{
    std::ranges::replace(name, '_', ' ');
    return name;
}

/// Terms of the ledger that are not zero, by their names.
std::string energy_line(const RunSummary& s)
{
    std::vector<std::string> in, spent;
    for (const LedgerTerm& term : ledger_terms)
        if (term.side != LedgerSide::aside && s.energy.*term.value != 0.0)
            (term.side == LedgerSide::in ? in : spent).push_back(fmt::format("{} {:.4g}", words(term.name), s.energy.*term.value));
    spent.push_back(fmt::format("stored {:.4g}", s.stored.total()));
    return fmt::format("energy [J]: {} -> {}; residual {:.2g} ({:.1e} of the largest)",
                       in.empty() ? "none" : fmt::format("{}", fmt::join(in, ", ")), fmt::join(spent, ", "),
                       residual(s.energy, s.stored), relative_residual(s.energy, s.stored));
}

/// A line for each bolt; of many those that bear most.
void print_bolts(Log& log, std::vector<BoltSummary> bolts)
{
    constexpr std::size_t most = 20;
    if (bolts.empty())
        return;
    double stored = 0.0, spent = 0.0;
    for (const BoltSummary& bolt : bolts)
    {
        stored += bolt.stored;
        spent += bolt.spent;
    }
    log.line(fmt::format("bolts: {}; they hold {:.4g} J and have spent {:.4g} J a metre of thickness. Forces of one bolt:",
                         bolts.size(), stored, spent));
    if (bolts.size() > most)
        std::ranges::stable_sort(bolts, std::greater<>(), &BoltSummary::axial_force);
    log.line(fmt::format("  {:<16} {:<9} {:<9} {:>12} {:>12} {:>12} {:>14}", "bolt", "kind", "status", "axial [N]", "across [N]",
                         "greatest [N]", "elongation [m]"));
    for (std::size_t i = 0; i < std::min(most, bolts.size()); ++i)
        log.line(fmt::format("  {:<16} {:<9} {:<9} {:>12.5g} {:>12.5g} {:>12.5g} {:>14.4g}", bolts[i].name, bolts[i].kind,
                             bolts[i].status, bolts[i].axial_force, bolts[i].across_force, bolts[i].greatest_force,
                             bolts[i].elongation));
    if (bolts.size() > most)
        log.line(fmt::format("  and {} that bear less: summary.json has all", bolts.size() - most));
}

void print_liners(Log& log, const std::vector<LinerSummary>& liners)
{
    if (liners.empty())
        return;
    log.line("liners, of a metre out of plane: the greatest anywhere in each");
    log.line(fmt::format("  {:<16} {:>12} {:>14} {:>18} {:>8} {:>12}", "liner", "thrust [N]", "moment [N m]", "displacement [m]",
                         "hinges", "parted [m]"));
    for (const LinerSummary& l : liners)
        if (l.installed)
            log.line(fmt::format("  {:<16} {:>12.5g} {:>14.5g} {:>18.4g} {:>8} {:>12.4g}", l.name, l.thrust, l.moment,
                                 l.displacement, l.hinges, l.parted));
        else
            log.line(fmt::format("  {:<16} not installed", l.name));
}

/// One word for the run.
std::string outcome_word(const RunSummary& s)
{
    const auto any = [&](bool StageSummary::*is) { return std::ranges::any_of(s.stages, is); };
    if (!s.met_ends)
        return any(&StageSummary::sought_end) ? "NOT at its ends" : "NOT converged";
    return !s.stages.empty() && s.stages.back().sought_rest && s.converged ? "converged" : "done";
}

/// How each stage ended. With many of them only the first and the last.
std::vector<std::string> stage_table(const RunSummary& s, const Model& model)
{
    constexpr std::size_t most = 12;
    std::vector<std::string> lines{fmt::format("{:<16} {:>9} {:>10}  ended by", "stage", "cycles", "time [s]")};
    for (std::size_t i = 0; i < s.stages.size(); ++i)
    {
        const StageSummary& stage = s.stages[i];
        if (s.stages.size() > most && i >= most / 2 && i + most / 2 < s.stages.size())
        {
            if (i == most / 2)
                lines.push_back(fmt::format("... {} more", s.stages.size() - most));
            continue;
        }
        std::string end = stage.ended_by;
        if (stage.end_value)
            end += fmt::format(" ({:.5g})", *stage.end_value);
        if (!stage.met_end)
            end += ": none of its ends was met";
        const bool is_over = i + 1 == s.stages.size() && stage.at_rest && stage.to_come.empty() &&
                             model.convergence.blocks == ConvergenceBlocks::all;
        if (stage.ended_by == "at rest" || is_over)
            end += ": no load changes, nothing more can happen";
        if (!stage.to_come.empty())
            end += fmt::format("; then {}", fmt::join(stage.to_come, "; "));
        lines.push_back(fmt::format("{:<16} {:>9} {:>10.4g}  {}", printable(stage.name), stage.cycles, stage.end_time, end));
    }
    return lines;
}
}  // namespace

void print_closing(Log& log, const RunSummary& s, const Session& session, const Simulation& simulation, const fs::path& folder)
{
    log.line("");
    log.line(
        fmt::format("{} after {} cycles ({:.4g} s){}", outcome_word(s), s.cycles, s.time,
                    s.cycles_after_excavation ? fmt::format(", {} of them after the excavation", *s.cycles_after_excavation) : ""));
    for (const std::string& line : stage_table(s, simulation.model()))
        log.line(line);
    for (const StageSummary& stage : s.stages)
    {
        if (stage.not_at_rest.empty())
            continue;
        const bool is_last = &stage == &s.stages.back();
        log.line(fmt::format("not at rest at the end of stage \"{}\": {} blocks{}: {}", stage.name, stage.not_at_rest.size(),
                             is_last ? ", the fastest first" : "",
                             first_of(is_last ? fastest_first(stage.not_at_rest, simulation.model(), simulation.state().blocks)
                                              : stage.not_at_rest)));
    }
    if (const StageSummary* last = s.stages.empty() ? nullptr : &s.stages.back(); last && last->sought_rest && !last->met_end)
        for (const LinerSummary& liner : s.liners)
            if (liner.moves)
                log.line(fmt::format("not at rest at the end of stage \"{}\": liner \"{}\"", last->name, liner.name));
    log.line(fmt::format("kinetic energy {:.4g} J (limit {:.4g} J), unbalanced force ratio {:.3g}", s.kinetic_energy,
                         s.kinetic_energy_limit, s.unbalanced_force_ratio));
    log.line(fmt::format("displacement {}: mean {:.4g} mm, greatest {:.4g} mm; all blocks: mean {:.4g} mm, greatest {:.4g} mm",
                         s.cycles_after_excavation ? "next to the excavation, without detached blocks" : "of free blocks",
                         1e3 * s.mean_displacement, 1e3 * s.max_displacement, 1e3 * s.mean_displacement_all,
                         1e3 * s.max_displacement_all));
    log.line(fmt::format("detached blocks: {}{}{}", s.detached_blocks.size(), s.detached_blocks.empty() ? "" : ": ",
                         first_of(s.detached_blocks)));
    if (!s.detached_before.empty())
        log.line(fmt::format("detached in earlier stages: {}: {}", s.detached_before.size(), first_of(s.detached_before)));
    print_bolts(log, s.bolts);
    print_liners(log, s.liners);
    log.line(energy_line(s));
    const ContactCounts contacts = simulation.count_contacts();
    log.line(
        fmt::format("contact points: {} stick, {} slip, {} impulse", contacts.points[1], contacts.points[2], contacts.points[3]));
    const State& state = simulation.state();
    log.line(fmt::format("contacts found anew {} times; facing edges searched {} times, {:.2g} times a contact and cycle",
                         state.broad_phase_runs, state.feature_searches,
                         static_cast<double>(state.feature_searches) /
                             std::max(static_cast<double>(state.contacts.size()) * static_cast<double>(state.cycle), 1.0)));
    for (const std::string& line : timing_table(s.timing))
        log.line(line);
    log.line(thread_line(s.thread_use));
    const double seconds = std::max(session.seconds, 1e-9);
    const std::string since_restart = session.first_cycle > 0
                                          ? fmt::format(" over all restarts; since the last {}", duration_text(session.seconds))
                                          : std::string();
    log.line(
        fmt::format("wall time {}{}, {:.0f} cycles/s, {:.4g} million contact-point updates/s; {:.2f} of {} threads busy, memory "
                    "at most {:.0f} MB",
                    duration_text(s.wall_seconds), since_restart, static_cast<double>(s.cycles - session.first_cycle) / seconds,
                    1e-6 * s.contact_point_updates_per_second, session.cpu_seconds / seconds, s.threads, peak_megabytes()));
    for (const std::string& warning : run_warnings(simulation, s))
        log.line("warning: " + warning);
    log.line(fmt::format("state hash {:016x}", s.state_hash));
    log.line(fmt::format("results in {}", folder.string()));
}
}  // namespace hdem
