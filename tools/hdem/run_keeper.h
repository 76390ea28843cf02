#pragma once
/// Takes checkpoints of a run, and breaks it off when a signal comes or the wall time is over.

#include "io/checkpoint.h"
#include "io/run_lock.h"
#include "io/run_recorder.h"
#include "parallel/stages.h"
#include "tools/hdem/screen.h"

#include <chrono>
#include <filesystem>
#include <optional>

namespace hdem
{
class RunKeeper : public Keeper
{
  public:
    using Clock = std::chrono::steady_clock;

    struct Settings
    {
        std::filesystem::path folder;
        const RunLock& lock;  ///< on the folder
        OutputDef output;
        Clock::time_point begin;         ///< of this program
        std::optional<double> max_wall;  ///< the run is broken off in time for this [s]
    };

    /// @param record of the run until now; its wall time counts on from there
    RunKeeper(Settings settings, RunRecord record, RunRecorder& recorder, Log& log);

    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override;
    [[nodiscard]] bool keep(const Simulation& simulation) override;
    [[nodiscard]] bool is_to_stop() override;
    void follow_statics(int iterations, double ratio) override;

    /// The run has come to its end.
    void finish(const Simulation& simulation);
    /// More stages were added to a run that had come to its end.
    void go_on() { record_.finished = false; }
    /// A checkpoint of this moment.
    void save_now(const Simulation& simulation) { save(simulation); }
    /// The text of the case has changed in stages to come.
    void take_case(const RunRecord& record);

    /// Exit code of a run that was broken off; nothing for one that was not.
    [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }
    /// Spent in cycles and output, over all restarts [s].
    [[nodiscard]] double wall_seconds() const;

  private:
    void save(const Simulation& simulation);
    [[nodiscard]] bool is_late() const;

    Settings settings_;
    RunRecord record_;
    RunRecorder& recorder_;
    Log& log_;
    double earlier_seconds_ = 0.0;  ///< spent by earlier programs
    Clock::time_point first_ = Clock::now();
    Clock::time_point last_save_ = first_;
    double save_seconds_ = 0.0;  ///< that the last checkpoint took
    Clock::time_point statics_begin_ = first_;
    Clock::time_point statics_line_ = first_;  ///< when the last line about them was printed
    std::optional<int> exit_code_;
};
}  // namespace hdem
