#include "tools/hdem/run_keeper.h"

#include "parallel/state_check.h"
#include "tools/hdem/options.h"
#include "tools/hdem/signals.h"

#include <fmt/format.h>

#include <csignal>
#include <tuple>

namespace hdem
{
namespace
{
double since(RunKeeper::Clock::time_point begin)
{
    return std::chrono::duration<double>(RunKeeper::Clock::now() - begin).count();
}
}  // namespace

RunKeeper::RunKeeper(Settings settings, RunRecord record, RunRecorder& recorder, Log& log)
    : settings_(std::move(settings)),
      record_(std::move(record)),
      recorder_(recorder),
      log_(log),
      earlier_seconds_(record_.wall_seconds)
{
    record_.finished = false;
}

double RunKeeper::wall_seconds() const
{
    return earlier_seconds_ + since(first_);
}

std::int64_t RunKeeper::next_cycle(std::int64_t now) const
{
    return next_multiple(now, settings_.output.checkpoint_every);
}

bool RunKeeper::keep(const Simulation& simulation)
{
    const auto& [every, minutes] = std::tie(settings_.output.checkpoint_every, settings_.output.checkpoint_wall_minutes);
    const std::int64_t cycle = simulation.state().cycle;
    const bool asked = checkpoint_requested();
    const bool due = (every > 0 && cycle % every == 0) || (minutes > 0.0 && since(last_save_) >= 60.0 * minutes);
    const int signal = interrupt();
    const bool late = is_late();
    if (!asked && !due && signal == 0 && !late)
        return true;
    save(simulation);
    if (asked)
        log_.line(fmt::format("SIGUSR1: checkpoint at cycle {}", cycle));
    if (signal == 0 && !late)
        return true;
    exit_code_ = signal != 0 ? 128 + signal : static_cast<int>(exit_wall_time);
    const char* const why = signal != 0 ? interrupt_name() : "--max-wall";
    log_.line(fmt::format("{}: stopped after cycle {}. Go on with: hdem run --restart {}", why, cycle, settings_.folder.string()));
    return false;
}

bool RunKeeper::is_to_stop()
{
    return interrupt() != 0 || is_late();
}

void RunKeeper::follow_statics(int iterations, double ratio)
{
    constexpr double line_every = 30.0;  // [s]
    if (iterations == 1)
        statics_begin_ = statics_line_ = Clock::now();
    const std::string text = fmt::format("static solution: iteration {}, {}, unbalanced force ratio {:.2g}", iterations,
                                         duration_text(since(statics_begin_)), ratio);
    if (since(statics_line_) < line_every)
        return log_.progress(text);
    log_.line(text);
    statics_line_ = Clock::now();
}

bool RunKeeper::is_late() const
{
    return settings_.max_wall && since(settings_.begin) + save_seconds_ >= *settings_.max_wall;
}

void RunKeeper::finish(const Simulation& simulation)
{
    record_.finished = true;
    save(simulation);
}

void RunKeeper::take_case(const RunRecord& record)
{
    record_.case_text = record.case_text;
    record_.files = record.files;
    record_.overrides = record.overrides;
}

void RunKeeper::save(const Simulation& simulation)
{
    const Clock::time_point begin = Clock::now();
    settings_.lock.check();
    check_finite(simulation.model(), simulation.state());  // a state that blew up must not take the place of a sound one
    recorder_.save();  // before the checkpoint: rows younger than it are dropped at a restart, missing ones would stay so
    record_.history_axes = recorder_.history_axes();
    record_.wall_seconds = wall_seconds();
    write_checkpoint(settings_.folder, record_, simulation.model(), simulation.state());
    last_save_ = Clock::now();
    save_seconds_ = since(begin);
}
}  // namespace hdem
