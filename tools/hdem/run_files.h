#pragma once
/// A run and what it leaves in its folder: log, frames, histories, checkpoints, summary. The same for `hdem run` and for a run that Python drives.

#include "io/run_recorder.h"
#include "tools/hdem/run_keeper.h"
#include "tools/hdem/run_report.h"
#include "tools/hdem/timing.h"

#include <memory>
#include <vector>

namespace hdem
{
/// The log of a run that begins, in its folder, once what an older run left there is gone: see clear_for_run, whose notes `start` takes.
[[nodiscard]] std::unique_ptr<Log> begin_log(RunStart& start, const RunOptions& options);

class RunFiles
{
  public:
    using Clock = RunKeeper::Clock;

    /// Prints what is to run.
    /// @param begin  of the program
    /// @param start  takes the warnings of the state in which the run begins
    RunFiles(RunStart& start, const RunOptions& options, Simulation& simulation, Log& log, Clock::time_point begin);

    /// See run_stages. Throws what that throws, once what led to it is on the disk.
    /// @param also  see the states too, after the recorder
    /// @param keeper  asked in place of keeper(), if given
    std::vector<StageResult> run(Simulation& simulation, const std::vector<Observer*>& also = {}, Keeper* keeper = nullptr,
                                 const StagePart& part = {});
    /// Closes a run that has come to its end: last results, and the summary. Throws RunError where its energies do not add up.
    [[nodiscard]] RunSummary finish(const RunStart& start, Simulation& simulation, const std::vector<StageResult>& stages);
    /// The text of the case has changed in stages to come.
    void take_case(const RunRecord& record);
    /// A frame of a run that is broken off.
    void show_interruption(const Simulation& simulation);

    [[nodiscard]] RunKeeper& keeper() { return keeper_; }
    [[nodiscard]] RunRecorder& recorder() { return *recorder_; }

  private:
    void save_last_moment(const RunError& error, const Simulation& simulation);

    std::filesystem::path folder_;
    const RunLock& lock_;  ///< that start holds
    Log& log_;
    std::unique_ptr<RunRecorder> recorder_;
    RowObserver rows_;
    RunKeeper keeper_;
    Session session_;
};
}  // namespace hdem
