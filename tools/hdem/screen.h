#pragma once
/// What a run says while it goes on: banner, rows, progress line; to the screen and to run.log.

#include "core/observer.h"
#include "parallel/stages.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace hdem
{
/// Lines go to standard output (unless quiet) and to the log file.
class Log
{
  public:
    enum class Begin
    {
        anew,
        behind_the_last_run
    };
    Log(const std::filesystem::path& file, bool quiet, Begin begin);
    ~Log();
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    void line(const std::string& text) { lines({&text, 1}); }
    /// Written at once: calls of the system cost more than texts where stages are short.
    void lines(std::span<const std::string> texts);
    /// Only to the log file: what the screen is told by others.
    void to_file(const std::string& text);
    /// Overwritten by the next line; only on a terminal, never in the log.
    void progress(const std::string& text);
    [[nodiscard]] bool is_interactive() const { return interactive_; }

  private:
    std::FILE* file_ = nullptr;
    bool quiet_ = false;
    bool interactive_ = false;
    bool progress_shown_ = false;
};

/// Rows of the run: cycle, time, energy, unbalanced ratio, contact points by regime, speed, time left.
class RowObserver : public Observer
{
  public:
    RowObserver(const Simulation& simulation, Log& log);

    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override;
    void begin_stage(const Model& model, const State& state) override;
    void observe(const Model& model, const State& state) override;

  private:
    const Simulation& simulation_;
    Log& log_;
    std::chrono::steady_clock::time_point stage_time_;
    std::int64_t first_cycle_ = 0;  ///< of the stage, or after a restart
    std::int64_t row_cycle_ = -1;
};

/// "1 h 05 min", "3 min 20 s", "4.2 s"
[[nodiscard]] std::string duration_text(double seconds);
}  // namespace hdem
