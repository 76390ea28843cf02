#include "tools/hdem/run_report.h"

#include "core/joint/normal_closure.h"
#include "core/stage/rules.h"
#include "core/state/state_hash.h"
#include "core/version.h"
#include "tools/hdem/run_figures.h"
#include "tools/hdem/timing.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

std::vector<std::string> names_of(const Model& model, const std::vector<Index>& user_numbers)
{
    std::vector<std::string> names;
    for (const Index user : user_numbers)
        names.push_back(model.name[model.slot_of_user[user]]);
    return names;
}
}  // namespace

namespace
{
/// Linings that fall, still move or have moved too far.
void add_liner_warnings(const RunSummary& s, std::vector<std::string>& warnings)
{
    const bool sought_rest = !s.stages.empty() && s.stages.back().sought_rest;
    for (const LinerSummary& l : s.liners)
    {
        if (l.is_off)
            warnings.push_back(fmt::format("liner \"{}\" has come off the rock along all of its length, and falls. The end of a "
                                           "stage is that of the rock without it.",
                                           l.name));
        else if (l.moves && (sought_rest || l.is_far))
            warnings.push_back(fmt::format("liner \"{}\" is not at rest: {:.3g} of the load of a node is out of balance, "
                                           "displacement {:.3g} m. Give it more strength if it fails, or the stage more cycles.",
                                           l.name, l.unbalanced, l.displacement));
        if (!l.is_off && l.is_far)
            warnings.push_back(fmt::format("liner \"{}\" has moved by {:.3g} m, more than its thickness: its forces hold for "
                                           "small displacements. It has failed, or the rock behind it has.",
                                           l.name, l.displacement));
    }
}

/// Joints that end above the stress from which on their normal spring is a straight line.
void add_straight_joints(const Model& model, const Contacts& contacts, std::vector<std::string>& warnings)
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
        if (const double limit = row.numbers[curve_cap_stress]; greatest > limit)
            warnings.push_back(
                fmt::format("joint \"{}\" bears up to {:.4g} Pa; from {:.4g} Pa on its normal spring is a straight line. Give it "
                            "a greater normal_stress.",
                            model.joints.names[j], greatest, limit));
    }
}

/// Is a motion prescribed in some stage? Not by a servo: its wall stops once it presses with its target.
bool is_ever_driven(const Model& model)
{
    return model.is_driven || std::ranges::any_of(model.loads, &Load::prescribes) ||
           std::ranges::any_of(model.boundaries, [](const Boundary& side) { return side.kind == BoundaryKind::velocity; });
}

/// Local damping opposes absolute velocities where held blocks do not move as one body: what they carry or push is then held back.
void add_damping_warning(const Simulation& simulation, std::vector<std::string>& warnings)
{
    constexpr double noticed = 0.05;  // of the work
    const EnergyLedger& ledger = simulation.state().ledger;
    const double work = std::max(std::abs(ledger.load_work + ledger.boundary), std::abs(ledger.gravity_work));
    if (!is_ever_driven(simulation.model()) || !(ledger.local_damping > noticed * work) || !(work > 0.0))
        return;
    warnings.push_back(
        fmt::format("local damping took {:.2g} % of the work of weights and prescribed motions: forces on blocks that a moving "
                    "block carries or "
                    "pushes may be wrong by as much. Use damping.preset = \"dynamic\" or the method impulse, or move more slowly.",
                    100.0 * ledger.local_damping / work));
}
}  // namespace

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
    add_straight_joints(model, simulation.state().contacts, warnings);
    add_liner_warnings(s, warnings);
    add_damping_warning(simulation, warnings);
    if (const WorstResidual& watch = simulation.state().worst_residual; watch.share > 1.0)
        warnings.push_back(
            fmt::format("energy ledger: residual = {:.2g} of its largest term in cycle {} ({:.3g} times what it should be). "
                        "Give a smaller time.step or time.stable_fraction.",
                        watch.residual, watch.cycle, watch.share));
    return warnings;
}

namespace
{
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
}  // namespace

double cpu_seconds()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
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
    s.converged = std::ranges::all_of(stages, [](const StageResult& stage) { return !stage.sought_rest || stage.at_rest; });
    s.met_ends = std::ranges::all_of(stages, &StageResult::met_end);
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
    for (const Index block : moved.before)
        s.detached_before.push_back(model.name[block]);
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
    s.warnings.insert(s.warnings.end(), start.record.warnings.begin(), start.record.warnings.end());
    for (std::string& warning : run_warnings(simulation, s))
        s.warnings.push_back(std::move(warning));
    return s;
}
}  // namespace hdem
