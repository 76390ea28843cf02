#include "tools/hdem/run_report.h"

#include "core/energy_ledger.h"
#include "core/joint/normal_closure.h"
#include "core/stage/rules.h"
#include "core/state/state_hash.h"
#include "core/version.h"
#include "io/digest.h"
#include "tools/hdem/timing.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <thread>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

Index free_blocks(const State& state)
{
    Index count = 0;
    for (Index i = 0; i < state.blocks.size(); ++i)
        count += state.blocks.is_free(i) ? 1 : 0;
    return count;
}

Index present_blocks(const State& state)
{
    return std::accumulate(state.blocks.present.begin(), state.blocks.present.end(), Index{0});
}

std::vector<std::string> names_of(const Model& model, const std::vector<Index>& user_numbers)
{
    std::vector<std::string> names;
    for (const Index user : user_numbers)
        names.push_back(model.name[model.slot_of_user[user]]);
    return names;
}

double smallest_free_mass(const Model& model, const State& state)
{
    double mass = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (state.blocks.is_free(i))
            mass = std::min(mass, model.mass[i]);
    return mass;
}

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

/// The first ones, and how many more.
std::string first_of(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 10;
    const auto shown = static_cast<std::ptrdiff_t>(std::min(most, names.size()));
    return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + shown, ", "),
                       names.size() > most ? fmt::format(" and {} more", names.size() - most) : "");
}

/// What a user must know of a run that came to its end.
std::vector<std::string> run_warnings(const Simulation& simulation, const RunSummary& s)
{
    std::vector<std::string> warnings;
    if (!s.stages.empty() && !s.stages.back().to_come.empty())
        warnings.push_back(
            fmt::format("the run ended in cycle {}, but {}. Let the last stage last longer, or let these end earlier.", s.cycles,
                        fmt::join(s.stages.back().to_come, "; ")));
    if (!s.lost_blocks.empty())
        warnings.push_back(
            fmt::format("blocks have left the model and are held outside it: {}. Give walls or a ground to hold them, or a "
                        "greater convergence.lost_distance.",
                        first_of(s.lost_blocks)));
    std::vector<std::string> outside;
    const Model& model = simulation.model();
    for (const Index block : model.slot_of_user)
        if (has_left(block, model, simulation.state().blocks) && simulation.state().blocks.is_free(block))
            outside.push_back(model.name[block]);
    if (!outside.empty())
        warnings.push_back(
            fmt::format("blocks have left the model and move on outside it: {}. Give walls or a ground to hold them, or "
                        "a stage with until = \"converged\", which ends their way.",
                        first_of(outside)));
    if (const WorstResidual& watch = simulation.state().worst_residual; watch.share > 1.0)
        warnings.push_back(
            fmt::format("energy ledger: residual = {:.2g} of its largest term in cycle {} ({:.3g} times what it should be). "
                        "Give a smaller time.step or time.stable_fraction.",
                        watch.residual, watch.cycle, watch.share));
    return warnings;
}

/// What ended a stage, in words.
std::string end_of(const StageResult& stage, const StageDef& def)
{
    if (stage.ended_by >= 0)
        return def.ends[static_cast<std::size_t>(stage.ended_by)].text;
    if (stage.ended_by == ended_by::rest)
        return "converged";
    if (stage.ended_by == ended_by::nothing_more)
        return "at rest";
    return def.cycles ? "cycles" : (def.duration ? "duration" : "max_cycles");
}

StageSummary summary_of(const StageResult& stage, const StageDef& def, const Model& model)
{
    return {.name = stage.name,
            .cycles = stage.cycles,
            .sought_rest = stage.sought_rest,
            .at_rest = stage.at_rest,
            .not_at_rest = names_of(model, stage.not_at_rest),
            .wall_seconds = stage.wall_seconds,
            .statics = stage.statics,
            .sought_end = stage.sought_end,
            .met_end = stage.met_end(),
            .ended_by = end_of(stage, def),
            .end_value = stage.ended_by >= 0 ? std::optional<double>(stage.value) : std::nullopt,
            .end_time = stage.time,
            .to_come = stage.to_come};
}

double peak_megabytes()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}
}  // namespace

double cpu_seconds()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

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

namespace
{
/// "spacing 1.21 m (1.2)": what came out, and the mean of the distribution.
std::string drawn_text(const char* name, const DrawnNumber& drawn, const char* unit)
{
    return drawn.count == 0 ? "" : fmt::format(", {} {:.7g}{} ({:.10g})", name, drawn.mean(), unit, drawn.expected);
}
}  // namespace

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
             {std::pair(set.dead_ends, "dropped as dead ends"), std::pair(set.welded, "welded to join slivers")})
            if (length > 0.0 && set.length > 0.0)
                line += fmt::format(", {:.6g} m ({:.3g} %) {}", length, 100.0 * length / set.length, what);
        lines.push_back(line);
    }
    return lines;
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
    if (simulation.model().insitu.given && !start.restarted)
        for (const std::string& warning :
             insitu_warnings(simulation.model(), summarise_insitu(simulation.model(), simulation.state())))
            log.line(warning);
}

RunSummary summarise(const RunStart& start, const Simulation& simulation, const std::vector<StageResult>& stages,
                     const Session& session, double wall_seconds)
{
    const Model& model = simulation.model();
    const State& state = simulation.state();
    const Equilibrium now = simulation.equilibrium();
    const DisplacementReport moved = report_displacements(model, state);
    RunSummary s;
    s.case_name = fs::path(start.record.case_file).filename().string();
    s.title = model.title;
    s.joint_sets = start.loaded.setup.rock.sets;
    s.method = name_of(state.method);
    s.threads = simulation.threads();
    s.thread_use = summarise_threads(simulation.thread_choice());
    s.version = version().number;
    s.git_commit = version().commit;
    s.blocks = present_blocks(state);
    s.free_blocks = free_blocks(state);
    s.contact_points = simulation.count_contacts().closed();
    s.time_step = model.time_step;
    s.paper_time_step = model.paper_time_step;
    s.smallest_block_mass = smallest_free_mass(model, state);
    s.cycles = state.cycle;
    s.time = state.time;
    s.converged = std::ranges::all_of(stages, &StageResult::met_end);
    if (state.excavation_cycle >= 0)
        s.cycles_after_excavation = state.cycle - state.excavation_cycle;
    for (std::size_t i = 0; i < stages.size(); ++i)
        s.stages.push_back(summary_of(stages[i], model.stages[i], model));
    s.kinetic_energy = now.kinetic_energy;
    s.kinetic_energy_limit = now.kinetic_energy_at(model.convergence.mean_speed);
    s.unbalanced_force_ratio = now.unbalanced_force_ratio();
    s.mean_displacement = moved.mean;
    s.max_displacement = moved.greatest;
    s.mean_displacement_all = moved.mean_all;
    s.max_displacement_all = moved.greatest_all;
    for (const Index block : moved.detached)
        s.detached_blocks.push_back(model.name[block]);
    s.bolts = summarise_bolts(model, state);
    s.liners = summarise_liners(model, state);
    s.energy = state.ledger;
    s.stored = stored_energy(model, state);
    s.wall_seconds = wall_seconds;
    s.contact_point_updates_per_second = static_cast<double>(simulation.contact_point_updates()) / std::max(session.seconds, 1e-9);
    s.timing = summarise_times(simulation.stage_times(), session.output_seconds, session.seconds);
    s.state_hash = state_hash(model, state);
    for (const Index block : model.slot_of_user)
        if (has_left(block, model, state.blocks) && !state.blocks.is_free(block))
            s.lost_blocks.push_back(model.name[block]);
    for (const Problem& warning : start.loaded.warnings)
        s.warnings.push_back(warning.text);
    for (std::string& warning : run_warnings(simulation, s))
        s.warnings.push_back(std::move(warning));
    return s;
}

namespace
{
/// Joints that end above the stress from which on their normal spring is a straight line.
void print_straight_joints(Log& log, const Model& model, const Contacts& contacts)
{
    for (std::size_t j = 0; j < model.joints.names.size() && model.joints.has_memory(); ++j)
    {
        const JointRow& row = model.joints.rows[j];
        if (row.curve == CurveKind::linear)
            continue;
        double greatest = 0.0;
        for (Index i = 0; i < contacts.size(); ++i)
            if (contacts.law[i] == static_cast<Index>(j))
                for (int k = 0; k < 2; ++k)
                    greatest = std::max(greatest, contacts.normal_force(k, i) / contacts.lane[i / lanes].last_length[i % lanes]);
        const double limit = row.numbers[curve_cap_stress];
        if (greatest > limit)
            log.line(fmt::format("warning: joint \"{}\" bears up to {:.4g} Pa; from {:.4g} Pa on its normal spring is a straight "
                                 "line. Give it a greater "
                                 "normal_stress.",
                                 model.joints.names[j], greatest, limit));
    }
}
}  // namespace

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

namespace
{
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
    for (const LinerSummary& l : liners)
        if (l.is_far)
            log.line(fmt::format(
                "warning: liner \"{}\" has moved by {:.3g} m, more than its thickness: its forces hold for small displacements. "
                "It has failed, or the rock behind it has.",
                l.name, l.displacement));
}

/// One word for the run.
std::string outcome_word(const RunSummary& s)
{
    const auto any = [&](bool StageSummary::*is) { return std::ranges::any_of(s.stages, is); };
    const bool rests = std::ranges::all_of(s.stages, [](const StageSummary& stage) { return !stage.sought_rest || stage.at_rest; });
    if (!s.converged)
        return any(&StageSummary::sought_end) ? "NOT at its ends" : "NOT converged";
    return any(&StageSummary::sought_rest) && rests ? "converged" : "done";
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
        const bool is_over = i + 1 == s.stages.size() && stage.at_rest && stage.to_come.empty() && !model.is_driven &&
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
        if (!stage.not_at_rest.empty())
            log.line(fmt::format("not at rest at the end of stage \"{}\": {} blocks: {}", stage.name, stage.not_at_rest.size(),
                                 first_of(stage.not_at_rest)));
    print_straight_joints(log, simulation.model(), simulation.state().contacts);
    log.line(fmt::format("kinetic energy {:.4g} J (limit {:.4g} J), unbalanced force ratio {:.3g}", s.kinetic_energy,
                         s.kinetic_energy_limit, s.unbalanced_force_ratio));
    log.line(fmt::format("displacement {}: mean {:.4g} mm, greatest {:.4g} mm; all blocks: mean {:.4g} mm, greatest {:.4g} mm",
                         s.cycles_after_excavation ? "next to the excavation" : "of free blocks", 1e3 * s.mean_displacement,
                         1e3 * s.max_displacement, 1e3 * s.mean_displacement_all, 1e3 * s.max_displacement_all));
    log.line(fmt::format("detached blocks: {}{}{}", s.detached_blocks.size(), s.detached_blocks.empty() ? "" : ": ",
                         fmt::join(s.detached_blocks, ", ")));
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
    log.line(fmt::format("wall time {}, {:.0f} cycles/s, {:.4g} million contact-point updates/s; {:.2f} of {} threads busy, memory "
                         "at most {:.0f} MB",
                         duration_text(s.wall_seconds), static_cast<double>(s.cycles - session.first_cycle) / seconds,
                         1e-6 * s.contact_point_updates_per_second, session.cpu_seconds / seconds, s.threads, peak_megabytes()));
    for (const std::string& warning : run_warnings(simulation, s))
        log.line("warning: " + warning);
    log.line(fmt::format("state hash {:016x}", s.state_hash));
    log.line(fmt::format("results in {}", folder.string()));
}

std::vector<std::string> insitu_warnings(const Model& model, const InsituSummary& insitu)
{
    std::vector<std::string> warnings;
    if (insitu.field > 1e-3)
        warnings.push_back(
            fmt::format("warning: [insitu]: the field is not in equilibrium with gravity (it lacks {:.3g} of rho g). Blocks "
                        "will move. Give gradient = [.., rho g, ..], or surface and ratio.",
                        insitu.field));
    if (insitu.unbalance > 1e-9)
        warnings.push_back(
            fmt::format("warning: [insitu]: block {} is out of balance by {:.3g} of what acts on it. Look for a side that is "
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
            fmt::format("warning: [insitu]: {} joints ({:.4g} m) bear more shear than their strength, or tension, which they do "
                        "not take. They slip or open in the first cycle. `hdem check` lists them set by set.",
                        above, length));
    return warnings;
}
}  // namespace hdem
