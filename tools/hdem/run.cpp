/// hdem run: a case from its file, or from a checkpoint, to its results.

#include "io/atomic_file.h"
#include "io/run_recorder.h"
#include "tools/hdem/run_keeper.h"
#include "tools/hdem/run_report.h"
#include "tools/hdem/signals.h"

#include <fmt/format.h>

#include <memory>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

void make_folder(const fs::path& folder)
{
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed)
        throw RunError(
            fmt::format("{}: the folder cannot be made ({}). Give another one with -o.", folder.string(), failed.message()));
}

std::unique_ptr<RunRecorder> make_recorder(const RunStart& start, const RunOptions& options, const Simulation& simulation)
{
    Provenance provenance{.case_file = start.record.case_file,
                          .case_text = start.record.case_text,
                          .overrides = start.record.overrides,
                          .command_line = options.command_line,
                          .seed = start.loaded.file.def.generator.seed,
                          .threads = simulation.threads()};
    describe_machine(provenance);
    provenance.begin = start.record.begin;
    provenance.restarts = start.record.restarts;
    if (!start.restarted)
        return std::make_unique<RunRecorder>(start.folder, simulation.model(), std::move(provenance));
    return std::make_unique<RunRecorder>(start.folder, simulation.model(), std::move(provenance), simulation.state(),
                                         start.record.history_axes);
}

/// A run has failed: what led to it goes to the disk, if the disk is not what failed.
void save_last_moment(Log& log, const RunError& error, const Simulation& simulation, RunRecorder& recorder)
{
    log.line(std::string("error: ") + error.what());
    try
    {
        recorder.finish(simulation.model(), simulation.state());
        log.line(fmt::format("the last frame shows cycle {}", simulation.state().cycle));
    }
    catch (const RunError& second)
    {
        log.line(std::string("error: ") + second.what());
    }
    return method == Method::force ? "force" : (method == Method::impulse ? "impulse" : "hybrid");
}

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

double smallest_free_mass(const Model& model, const State& state)
{
    double mass = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (state.blocks.is_free(i))
            mass = std::min(mass, model.mass[i]);
    return mass;
}

void banner(Log& log, const LoadedCase& loaded, const RunOptions& options, Simulation& simulation)
{
    const Model& model = simulation.model();
    const State& state = simulation.state();
    log.line(std::string(version_line()));
    log.line(fmt::format("case      {} (SHA-256 {:.12}...){}", options.case_file, sha256_hex(loaded.file.source.text()),
                         model.title.empty() ? "" : fmt::format(": {}", model.title)));
    log.line(fmt::format("blocks    {}, of which {} free; smallest free one {:.4g} kg", present_blocks(state), free_blocks(state),
                         smallest_free_mass(model, state)));
    const RockMass& rock = loaded.setup.rock;
    if (rock.joints > 0)
        log.line(fmt::format("joints    {} traces, {} dead ends of them dropped, {} cuts; {} cuts refused (piece or edge too small), {} skipped by "
                             "persistence, {} slivers merged",
                             rock.joints, rock.dead_ends, rock.cuts, rock.refused_cuts, rock.skipped_cuts, rock.merged_slivers));
    log.line(fmt::format("method    {}; threshold scale {:.4g}", method_name(state.method), model.threshold_scale));
    log.line(fmt::format("threads   {} ({})", simulation.threads(), options.threads ? "--threads" : "OMP_NUM_THREADS or the processors at hand"));
    log.line(fmt::format("time step {:.4g} s; Eq. (32) {:.4g} s, stable limit of the present contacts {:.4g} s", model.time_step, model.paper_time_step,
                         simulation.critical_step()));
    for (const Problem& warning : loaded.warnings)
        log.line(warning.text);
}

RunSummary summarise(const LoadedCase& loaded, const RunOptions& options, const Simulation& simulation, const std::vector<StageResult>& stages, double seconds)
{
    const Model& model = simulation.model();
    const State& state = simulation.state();
    const Equilibrium now = simulation.equilibrium();
    const DisplacementReport moved = report_displacements(model, state);
    RunSummary s;
    s.case_name = fs::path(options.case_file).filename().string();
    s.title = model.title;
    s.method = method_name(state.method);
    s.threads = simulation.threads();
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
    s.converged = std::ranges::all_of(stages, [](const StageResult& stage) { return stage.converged || !stage.until_converged; });
    if (state.excavation_cycle >= 0)
        s.cycles_after_excavation = state.cycle - state.excavation_cycle;
    for (const StageResult& stage : stages)
        s.stages.push_back({.name = stage.name, .cycles = stage.cycles, .until_converged = stage.until_converged, .converged = stage.converged});
    s.kinetic_energy = now.kinetic_energy;
    s.kinetic_energy_limit = now.kinetic_energy_at(model.convergence.mean_speed);
    s.unbalanced_force_ratio = now.unbalanced_force_ratio();
    s.mean_displacement = moved.mean;
    s.max_displacement = moved.greatest;
    s.mean_displacement_all = moved.mean_all;
    s.max_displacement_all = moved.greatest_all;
    for (const Index block : moved.detached)
        s.detached_blocks.push_back(model.name[block]);
    s.energy = state.ledger;
    s.stored = stored_energy(model, state);
    s.wall_seconds = seconds;
    s.contact_point_updates_per_second = static_cast<double>(simulation.contact_point_updates()) / std::max(seconds, 1e-9);
    s.state_hash = state_hash(model, state);
    for (const Problem& warning : loaded.warnings)
        s.warnings.push_back(warning.text);
    return s;
}

void close(Log& log, const RunSummary& s, const fs::path& folder)
{
    log.line("");
    const bool aimed = std::ranges::any_of(s.stages, &StageSummary::until_converged);
    log.line(fmt::format("{} after {} cycles ({:.4g} s){}", !aimed ? "done" : (s.converged ? "converged" : "NOT converged"), s.cycles, s.time,
                         s.cycles_after_excavation ? fmt::format(", {} of them after the excavation", *s.cycles_after_excavation) : ""));
    log.line(fmt::format("kinetic energy {:.4g} J (limit {:.4g} J), unbalanced force ratio {:.3g}", s.kinetic_energy, s.kinetic_energy_limit,
                         s.unbalanced_force_ratio));
    log.line(fmt::format("displacement {}: mean {:.4g} mm, greatest {:.4g} mm; all blocks: mean {:.4g} mm, greatest {:.4g} mm",
                         s.cycles_after_excavation ? "next to the excavation" : "of free blocks", 1e3 * s.mean_displacement, 1e3 * s.max_displacement,
                         1e3 * s.mean_displacement_all, 1e3 * s.max_displacement_all));
    log.line(fmt::format("detached blocks: {}{}{}", s.detached_blocks.size(), s.detached_blocks.empty() ? "" : ": ", fmt::join(s.detached_blocks, ", ")));
    const EnergyLedger& e = s.energy;
    log.line(fmt::format("energy [J]: at the start {:.4g}, gravity {:.4g}, loads {:.4g}, position correction {:.4g} -> friction {:.4g}, "
                         "local damping {:.4g}, global damping {:.4g}, impulses {:.4g}, contact changes {:.4g}, removed {:.4g}, stored {:.4g}; "
                         "residual {:.2g} ({:.1e} of the largest)",
                         e.initial, e.gravity_work, e.load_work, e.position_correction, e.friction, e.local_damping, e.global_damping,
                         e.impulse_loss, e.contact_changes, e.removed, s.stored.total(), residual(e, s.stored),
                         relative_residual(e, s.stored)));
    log.line(fmt::format("wall time {}, {:.0f} cycles/s, {:.4g} million contact-point updates/s", duration_text(s.wall_seconds),
                         static_cast<double>(s.cycles) / std::max(s.wall_seconds, 1e-9), 1e-6 * s.contact_point_updates_per_second));
    log.line(fmt::format("state hash {:016x}", s.state_hash));
    log.line(fmt::format("results in {}", folder.string()));
}
}  // namespace

int run_command(const RunOptions& options)
{
    const RunKeeper::Clock::time_point begin = RunKeeper::Clock::now();
    catch_checkpoint_requests();
    RunStart start = start_run(options);
    const fs::path& folder = start.folder;
    Setup& setup = start.loaded.setup;
    Simulation simulation(std::move(setup.model), std::move(setup.state), options.threads.value_or(default_threads()));
    const std::vector<Problem> problems = start.restarted ? std::vector<Problem>{} : simulation.find_problems();
    if (!problems.empty())
        throw InputError(start.loaded.file.source.located(problems));

    make_folder(folder);
    if (!start.restarted)
        clear_for_new_run(folder, options.overwrite);
    remove_file(folder / "summary.json");  // that of an older run, or not yet the outcome
    Log log(folder / "run.log", options.quiet, start.restarted ? Log::Begin::behind_the_last_run : Log::Begin::anew);
    print_banner(log, start, options, simulation);

    const std::unique_ptr<RunRecorder> recorder = make_recorder(start, options, simulation);
    RowObserver rows(simulation, log);
    Observer* const observers[] = {&rows, recorder.get()};
    RunKeeper keeper({folder, simulation.model().output, begin, options.max_wall}, start.record, *recorder, log);
    Session session{.first_cycle = simulation.state().cycle, .seconds = 0.0, .cpu_seconds = cpu_seconds()};
    const auto first = RunKeeper::Clock::now();
    catch_interrupts();
    std::vector<StageResult> stages;
    try
    {
        stages = run_stages(simulation, observers, &keeper);
        session.seconds = std::chrono::duration<double>(RunKeeper::Clock::now() - first).count();
        session.cpu_seconds = cpu_seconds() - session.cpu_seconds;
        if (keeper.exit_code())
            return *keeper.exit_code();
        recorder->finish(simulation.model(), simulation.state());
        keeper.finish(simulation);
    }
    catch (const RunError& error)
    {
        save_last_moment(log, error, simulation, *recorder);
        throw;
    }
    const RunSummary summary = summarise(start, simulation, stages, session, keeper.wall_seconds());
    write_summary(folder / "summary.json", summary);
    print_closing(log, summary, session, simulation.count_contacts(), folder);
    return summary.converged ? exit_done : exit_no_convergence;
}
}  // namespace hdem
