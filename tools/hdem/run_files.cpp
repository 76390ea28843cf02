#include "tools/hdem/run_files.h"

#include "io/atomic_file.h"
#include "tools/hdem/run_folder.h"

#include <fmt/format.h>

namespace hdem
{
namespace
{
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
}  // namespace

std::unique_ptr<Log> begin_log(RunStart& start, const RunOptions& options)
{
    const std::vector<std::string> notes = clear_for_run(start, options.overwrite);
    start.notes.insert(start.notes.end(), notes.begin(), notes.end());
    return std::make_unique<Log>(start.folder / "run.log", options.quiet,
                                 start.restarted && !start.moved ? Log::Begin::behind_the_last_run : Log::Begin::anew);
}

namespace
{
/// What the summary at the end needs to know of the state in which the run begins.
RunStart& noted(RunStart& start, const Simulation& simulation)
{
    if (simulation.model().insitu.given && !start.restarted && simulation.state().cycle == 0)
        start.record.warnings = insitu_warnings(simulation.model(), summarise_insitu(simulation.model(), simulation.state()));
    return start;
}
}  // namespace

RunFiles::RunFiles(RunStart& start, const RunOptions& options, Simulation& simulation, Log& log, Clock::time_point begin)
    : folder_(start.folder),
      lock_(*start.lock),
      log_(log),
      recorder_((print_banner(log, noted(start, simulation), options, simulation), make_recorder(start, options, simulation))),
      rows_(simulation, log),
      keeper_({start.folder, *start.lock, simulation.model().output, begin, options.max_wall}, start.record, *recorder_, log),
      session_{.first_cycle = simulation.state().cycle}
{
    recorder_->ask_before_writing([&lock = lock_] { lock.check(); });
}

std::vector<StageResult> RunFiles::run(Simulation& simulation, const std::vector<Observer*>& also, Keeper* keeper,
                                       const StagePart& part)
{
    lock_.check();
    remove_file(folder_ / "summary.json");  // no more the outcome
    TimedObserver timed_rows(rows_, session_.output_seconds);
    TimedObserver timed_recorder(*recorder_, session_.output_seconds);
    std::vector<Observer*> observers{&timed_rows, &timed_recorder};
    observers.insert(observers.end(), also.begin(), also.end());
    TimedKeeper timed_keeper(keeper != nullptr ? *keeper : keeper_, session_.output_seconds);
    const double cpu_before = cpu_seconds();
    const auto first = Clock::now();
    try
    {
        std::vector<StageResult> stages = run_stages(simulation, observers, &timed_keeper, part);
        session_.seconds += std::chrono::duration<double>(Clock::now() - first).count();
        session_.cpu_seconds += cpu_seconds() - cpu_before;
        return stages;
    }
    catch (const RunError& error)
    {
        save_last_moment(error, simulation);
        throw;
    }
}

void RunFiles::save_last_moment(const RunError& error, const Simulation& simulation)
{
    log_.to_file(std::string("error: ") + error.what());  // who called tells the screen
    if (!lock_.is_held())
        return;
    try
    {
        recorder_->finish(simulation.model(), simulation.state());
        log_.line(fmt::format("the last frame shows cycle {}", simulation.state().cycle));
    }
    catch (const RunError& second)
    {
        log_.line(std::string("error: ") + second.what());
    }
}

void RunFiles::take_case(const RunRecord& record)
{
    keeper_.take_case(record);
    recorder_->take_case(record.case_text, record.overrides);
}

void RunFiles::show_interruption(const Simulation& simulation)
{
    recorder_->show_interruption(simulation.model(), simulation.state());
}

RunSummary RunFiles::finish(const RunStart& start, Simulation& simulation, const std::vector<StageResult>& stages)
{
    try
    {
        recorder_->finish(simulation.model(), simulation.state());
        keeper_.finish(simulation);
    }
    catch (const RunError& error)
    {
        save_last_moment(error, simulation);
        throw;
    }
    RunSummary summary = summarise(start, simulation, stages, session_, keeper_.wall_seconds());
    write_summary(folder_ / "summary.json", summary);
    print_closing(log_, summary, session_, simulation, folder_);
    if (const WorstResidual& watch = simulation.state().worst_residual; watch.share > wrong_residual)
        throw RunError(
            fmt::format("energy ledger: residual = {:.2g} of its largest term in cycle {} (more than ten times what it should be: "
                        "the answer may be wrong by as much). Give a smaller time.step or time.stable_fraction. Results are in {}.",
                        watch.residual, watch.cycle, folder_.string()));
    return summary;
}
}  // namespace hdem
