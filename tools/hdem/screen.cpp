#include "tools/hdem/screen.h"

#include "core/check.h"
#include "core/stage/load_changes.h"
#include "core/stage/rules.h"
#include "io/fresh_file.h"
#include "io/printable.h"
#include "tools/hdem/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace hdem
{
Log::Log(const std::filesystem::path& file, bool quiet, Begin begin)
    : file_(open_log(file, begin == Begin::behind_the_last_run)),
      quiet_(quiet),
      interactive_(!quiet && isatty(STDERR_FILENO) != 0)
{
    if (file_ == nullptr)
        throw RunError(
            fmt::format("{}: cannot be written ({}). Give another folder with -o.", file.string(), std::strerror(errno)));
}

Log::~Log()
{
    if (progress_shown_)
        std::fputs("\r\033[K", stderr);
    std::fclose(file_);
}

void Log::lines(std::span<const std::string> texts)
{
    if (progress_shown_)
        std::fputs("\r\033[K", stderr);
    progress_shown_ = false;
    for (const std::string& text : texts)
    {
        if (!quiet_)
            say("{}\n", text);
        fmt::print(file_, "{}\n", printable(text));
    }
    if (!quiet_)
        std::fflush(stdout);
    std::fflush(file_);
}

void Log::to_file(const std::string& text)
{
    fmt::print(file_, "{}\n", printable(text));
    std::fflush(file_);
}

void Log::progress(const std::string& text)
{
    if (!interactive_)
        return;
    std::fputs("\r\033[K", stderr);
    complain_text(text);
    std::fflush(stderr);
    progress_shown_ = true;
}

std::string duration_text(double seconds)
{
    if (!(seconds < 1.0e9))
        return "-";
    if (seconds < 60.0)
        return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<std::int64_t>(seconds + 0.5);
    if (whole < 3600)
        return fmt::format("{} min {:02d} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02d} min", whole / 3600, whole % 3600 / 60);
}

RowObserver::RowObserver(const Simulation& simulation, Log& log) : simulation_(simulation), log_(log)
{
}

namespace
{
/// How long the steps of a stage are, where they vary.
std::vector<std::string> step_notes(const Model& model, const StepRule& rule)
{
    if (!rule.varies)
        return {};
    if (rule.keeps_given)
        return {fmt::format("note: the {:.4g} s given are kept while a block that has moved less than {:.4g} m in this stage is "
                            "faster than {:.4g} m/s. Else "
                            "steps are as long as what moves can bear. A stage with duration or cycles keeps them always.",
                            model.time_step, rule.loose_distance, rule.slow)};
    return {fmt::format(
        "note: no time.step is given: in this stage a cycle takes {:.4g} (time.stable_fraction) of the largest step that is "
        "stable for the blocks that are not at rest.",
        rule.stable_share)};
}

/// What a static solution at the beginning of the stage has found.
std::string statics_note(const Model& model, const StaticOutcome& statics)
{
    std::string names;
    constexpr std::size_t most_names = 10;
    for (std::size_t i = 0; i < std::min(statics.loose.size(), most_names); ++i)
        names += (i == 0 ? " " : ", ") + model.name[statics.loose[i]];
    if (statics.loose.size() > most_names)
        names += ", ...";
    const std::string effort = fmt::format("after {} iterations", statics.iterations);
    if (statics.kind == StaticOutcome::Kind::not_converged)
        return fmt::format("note: static solution: not found {}; the stage goes through cycles from its beginning.", effort);
    if (statics.kind == StaticOutcome::Kind::no_equilibrium)
        return fmt::format(
            "note: static solution: no equilibrium found {}; {} blocks kept moving:{}. The stage goes through cycles from "
            "its beginning.",
            effort, statics.loose.size(), names);
    const std::string found = fmt::format("note: static solution: {} balance {}, unbalanced force ratio {:.2g}",
                                          statics.kind == StaticOutcome::Kind::balanced ? "in" : "near", effort, statics.residual);
    return statics.loose.empty() ? found + "." : found + fmt::format("; {} blocks come away:{}.", statics.loose.size(), names);
}

/// Free blocks that are not left out as being at rest.
Index moving_blocks(const Blocks& blocks)
{
    Index moving = 0;
    for (Index i = 0; i < blocks.size(); ++i)
        moving += blocks.is_free(i) && blocks.takes_part(i) ? 1 : 0;
    return moving;
}
}  // namespace

std::int64_t RowObserver::next_cycle(std::int64_t now) const
{
    constexpr std::int64_t progress_every = 200;  // the progress line lives between rows, on a terminal only
    const std::int64_t every = simulation_.model().output.row_every;
    return next_multiple(now, log_.is_interactive() ? std::min(every, progress_every) : every);
}

void RowObserver::begin_stage(const Model& model, const State& state)
{
    const StageDef& stage = model.stages[state.stage];
    const std::int64_t most = last_cycle(stage, state.stage_begin_cycle, model.time_step) - state.stage_begin_cycle;
    stage_time_ = std::chrono::steady_clock::now();
    first_cycle_ = state.cycle;
    std::vector<std::string> lines = {""};
    if (state.cycle > state.stage_begin_cycle)
        lines.push_back(fmt::format("goes on after cycle {}", state.cycle));
    lines.push_back(ends_at_rest(stage)
                        ? fmt::format("stage \"{}\": until converged, at most {} cycles; kinetic energy limit {:.4g} J", stage.name,
                                      most, simulation_.equilibrium().kinetic_energy_at(model.convergence.mean_speed))
                    : stage.ends.empty() ? fmt::format("stage \"{}\": {} cycles", stage.name, most)
                                         : fmt::format("stage \"{}\": at most {} cycles", stage.name, most));
    for (const StageEndDef& end : stage.ends)
        lines.push_back(fmt::format("until     {}", printable(end.text)));
    for (const std::string& note : step_notes(model, resolve_rules(model, state).step))
        lines.push_back(note);
    if (simulation_.statics() && state.cycle == state.stage_begin_cycle)
    {
        lines.push_back(statics_note(model, *simulation_.statics()));
        if (!asks_for_statics(model.stages[state.stage]))
            lines.push_back(
                "note: it is sought as rock is removed slowly here, from a large model; solver = \"dynamic\" in the stage "
                "looks for rest by cycles alone.");
    }
    static const std::string heads = fmt::format("{:>9} {:>11} {:>9} {:>12} {:>11} {:>11} {:>7} {:>7} {:>7} {:>7} {:>10} {:>12}",
                                                 "cycle", "time [s]", "step [s]", "kinetic [J]", "unbalanced", "worst block",
                                                 "moving", "stick", "slip", "impulse", "cycles/s", "time left");
    lines.push_back(heads);
    log_.lines(lines);
}

void RowObserver::observe(const Model& model, const State& state)
{
    if (state.cycle == first_cycle_ || state.cycle == row_cycle_)
        return;
    const StageDef& stage = model.stages[state.stage];
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - stage_time_).count();
    const double rate = static_cast<double>(state.cycle - first_cycle_) / std::max(seconds, 1e-9);
    const double left = static_cast<double>(last_cycle(stage, state.stage_begin_cycle, model.time_step) - state.cycle) / rate;
    const std::string left_text = (ends_at_rest(stage) ? "< " : "") + duration_text(left);
    const Equilibrium now = simulation_.equilibrium();
    if (log_.is_interactive() && next_multiple(state.cycle - 1, model.output.row_every) != state.cycle &&
        next_cycle(state.cycle - 1) == state.cycle)
    {
        log_.progress(fmt::format("cycle {}  kinetic energy {:.4g} J  {:.0f} cycles/s  time left {}", state.cycle,
                                  now.kinetic_energy, rate, left_text));
        return;
    }
    const ContactCounts counts = simulation_.count_contacts();
    log_.line(fmt::format("{:>9} {:>11.5g} {:>9.3g} {:>12.4e} {:>11.3e} {:>11.3e} {:>7} {:>7} {:>7} {:>7} {:>10.0f} {:>12}",
                          state.cycle, state.time, state.blocks.step.last, now.kinetic_energy, now.unbalanced_force_ratio(),
                          now.unbalanced.value, moving_blocks(state.blocks), counts.points[1], counts.points[2], counts.points[3],
                          rate, left_text));
    row_cycle_ = state.cycle;
}
}  // namespace hdem
