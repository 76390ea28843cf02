/// hdem run: a case from its file, or from a checkpoint, to its results.

#include "io/atomic_file.h"
#include "io/run_recorder.h"
#include "tools/hdem/finished_run.h"
#include "tools/hdem/live_page.h"
#include "tools/hdem/patience.h"
#include "tools/hdem/run_keeper.h"
#include "tools/hdem/signals.h"
#include "tools/hdem/timing.h"

#include <fmt/format.h>

#include <memory>

namespace hdem
{
namespace
{
namespace fs = std::filesystem;

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
    log.to_file(std::string("error: ") + error.what());  // main tells the screen
    try
    {
        recorder.finish(simulation.model(), simulation.state());
        log.line(fmt::format("the last frame shows cycle {}", simulation.state().cycle));
    }
    catch (const RunError& second)
    {
        log.line(std::string("error: ") + second.what());
    }
}
}  // namespace

FinishedRun run_case(const RunOptions& options, Observer* also)
{
    const RunKeeper::Clock::time_point begin = RunKeeper::Clock::now();
    if (options.live)
        LivePage::check();
    catch_checkpoint_requests();
    std::optional<Patience> patience(std::in_place, Patience::Settings{.work = "the case is read and its model built",
                                                                       .begin = begin,
                                                                       .max_wall = options.max_wall,
                                                                       .quiet = options.quiet});
    FinishedRun run{.start = start_run(options)};
    RunStart& start = run.start;
    const fs::path& folder = start.folder;
    Setup& setup = start.loaded.setup;
    run.simulation = std::make_unique<Simulation>(std::move(setup.model), std::move(setup.state), thread_rule(options.threads));
    Simulation& simulation = *run.simulation;
    const std::vector<Problem> problems = start.restarted ? std::vector<Problem>{} : simulation.find_problems();
    if (!problems.empty())
        throw InputError(start.loaded.file.source.located(problems));
    patience.reset();

    clear_for_run(start, options.overwrite);
    run.log = std::make_unique<Log>(folder / "run.log", options.quiet,
                                    start.restarted ? Log::Begin::behind_the_last_run : Log::Begin::anew);
    Log& log = *run.log;
    print_banner(log, start, options, simulation);

    const std::unique_ptr<RunRecorder> recorder = make_recorder(start, options, simulation);
    std::optional<LivePage> page;
    if (options.live)
    {
        page.emplace(folder);
        log.line(fmt::format("a page that follows the run: {}", (folder / "view.html").string()));
    }
    RowObserver rows(simulation, log);
    Session session{.first_cycle = simulation.state().cycle};
    TimedObserver timed_rows(rows, session.output_seconds);
    TimedObserver timed_recorder(*recorder, session.output_seconds);
    std::vector<Observer*> observers{&timed_rows, &timed_recorder};
    if (also != nullptr)
        observers.push_back(also);
    RunKeeper keeper({folder, simulation.model().output, begin, options.max_wall}, start.record, *recorder, log);
    TimedKeeper timed_keeper(keeper, session.output_seconds);
    session.cpu_seconds = cpu_seconds();
    const auto first = RunKeeper::Clock::now();
    catch_interrupts();
    try
    {
        run.stages = run_stages(simulation, observers, &timed_keeper);
        session.seconds = std::chrono::duration<double>(RunKeeper::Clock::now() - first).count();
        session.cpu_seconds = cpu_seconds() - session.cpu_seconds;
        if (keeper.exit_code())
        {
            recorder->show_interruption(simulation.model(), simulation.state());
            run.exit_code = *keeper.exit_code();
            return run;
        }
        recorder->finish(simulation.model(), simulation.state());
        keeper.finish(simulation);
    }
    catch (const RunError& error)
    {
        save_last_moment(log, error, simulation, *recorder);
        throw;
    }
    run.is_complete = true;
    run.summary = summarise(start, simulation, run.stages, session, keeper.wall_seconds());
    write_summary(folder / "summary.json", run.summary);
    print_closing(log, run.summary, session, simulation, folder);
    if (const WorstResidual& watch = simulation.state().worst_residual; watch.share > wrong_residual)
        throw RunError(
            fmt::format("energy ledger: residual = {:.2g} of its largest term in cycle {} (more than ten times what it should be: "
                        "the answer may be wrong by as much). Give a smaller time.step or time.stable_fraction. Results are in {}.",
                        watch.residual, watch.cycle, folder.string()));
    run.exit_code = run.summary.converged ? exit_done : exit_no_convergence;
    return run;
}

int run_command(const RunOptions& options)
{
    return run_case(options).exit_code;
}
}  // namespace hdem
