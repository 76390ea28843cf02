/// hdem run: a case from its file, or from a checkpoint, to its results.

#include "tools/hdem/console.h"
#include "tools/hdem/finished_run.h"
#include "tools/hdem/live_page.h"
#include "tools/hdem/patience.h"
#include "tools/hdem/run_files.h"
#include "tools/hdem/signals.h"

#include <fmt/format.h>

#include <memory>

namespace hdem
{

FinishedRun run_case(const RunOptions& options, Observer* also)
{
    const RunKeeper::Clock::time_point begin = RunKeeper::Clock::now();
    if (options.live)
        LivePage::check();
    outlive_reader();
    catch_checkpoint_requests();
    std::optional<Patience> patience(std::in_place, Patience::Settings{.work = "the case is read and its model built",
                                                                       .begin = begin,
                                                                       .max_wall = options.max_wall,
                                                                       .quiet = options.quiet});
    FinishedRun run{.start = start_run(options)};
    RunStart& start = run.start;
    const std::filesystem::path& folder = start.folder;
    Setup& setup = start.loaded.setup;
    run.simulation = std::make_unique<Simulation>(std::move(setup.model), std::move(setup.state), thread_rule(options.threads));
    Simulation& simulation = *run.simulation;
    const std::vector<Problem> problems = start.restarted ? std::vector<Problem>{} : simulation.find_problems();
    if (!problems.empty())
        throw InputError(start.loaded.file.source.located(problems));
    patience.reset();

    run.log = begin_log(start, options);
    RunFiles files(start, options, simulation, *run.log, begin);
    std::optional<LivePage> page;
    if (options.live)
    {
        page.emplace(folder);
        run.log->line(fmt::format("a page that follows the run: {}", (folder / "view.html").string()));
    }
    catch_interrupts();
    run.stages = files.run(simulation, also == nullptr ? std::vector<Observer*>{} : std::vector<Observer*>{also});
    if (files.keeper().exit_code())
    {
        files.show_interruption(simulation);
        run.exit_code = *files.keeper().exit_code();
        return run;
    }
    run.is_complete = true;
    run.summary = files.finish(start, simulation, run.stages);
    run.exit_code = run.summary.met_ends ? exit_done : exit_no_convergence;
    return run;
}

int run_command(const RunOptions& options)
{
    return run_case(options).exit_code;
}
}  // namespace hdem
