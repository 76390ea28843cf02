#include "parallel/stages.h"

#include "core/motion/released_forces.h"
#include "core/stage/load_changes.h"
#include "core/stage/rules.h"

#include <algorithm>
#include <chrono>
#include <iterator>

namespace hdem
{
namespace
{
constexpr std::int64_t check_every = 1000;
constexpr std::int64_t least_cycles_checked = 20;  ///< of a stage; it may have one only
constexpr std::int64_t finish_every = 10'000;      ///< cycles between static solutions in a stage whose blocks are all slow

void show(Simulation& simulation, std::span<Observer* const> observers, bool all)
{
    for (Observer* const observer : observers)
        if (all || observer->next_cycle(simulation.state().cycle - 1) == simulation.state().cycle)
            observer->observe(simulation.model(), simulation.state());
}

/// Finds how many cycles take about a fifth of a second: a keeper may wait so long.
class Pace
{
  public:
    [[nodiscard]] std::int64_t cycles() const { return cycles_; }
    void took(std::int64_t cycles)
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::max(std::chrono::duration<double>(now - last_).count(), 1e-6);
        last_ = now;
        cycles_ = std::clamp<std::int64_t>(static_cast<std::int64_t>(0.2 / seconds * static_cast<double>(cycles)), 1, 4 * cycles_);
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::int64_t cycles_ = 1;
};

/// Blocks that belong to the stage: the user's numbers.
std::vector<Index> blocks_of_stage(const std::vector<StageBlock>& blocks, Index stage)
{
    std::vector<Index> found;
    for (const StageBlock& b : blocks)
        if (b.stage == stage)
            found.push_back(b.block);
    return found;
}

/// What the static solution at the beginning of the stage found, if it was tried.
std::optional<StaticResult> static_result(const Model& model, const State& state, Index stage)
{
    const auto found = std::ranges::find(state.statics, stage, &StaticSolution::stage);
    if (found == state.statics.end())
        return std::nullopt;
    StaticResult result{.outcome = name_of(found->end), .iterations = found->iterations, .residual = found->residual};
    for (const Index user : blocks_of_stage(state.came_loose, stage))
        result.loose.push_back(model.name[model.slot_of_user[user]]);
    return result;
}

/// When a stage ends.
std::vector<std::string> what_goes_on(const Model& model, const State& state, bool at_rest)
{
    std::vector<std::string> all = changes_to_come(model, state);
    if (at_rest)
        std::ranges::move(motions_that_go_on(model, state), std::back_inserter(all));
    return all;
}

class StageRunner
{
  public:
    StageRunner(Simulation& simulation, std::span<Observer* const> observers, Keeper* keeper)
        : simulation_(simulation),
          observers_(observers),
          keeper_(keeper)
    {
    }

    /// The stage that the state is in, from its present cycle on.
    StageResult run(std::chrono::steady_clock::time_point begun)
    {
        const State& state = simulation_.state();
        def_ = &simulation_.model().stages[state.stage];
        begin_ = state.stage_begin_cycle;
        end_ = last_cycle(*def_, begin_, simulation_.model().time_step);
        StageResult result{
            .name = def_->name, .first_cycle = begin_, .sought_rest = ends_at_rest(*def_), .sought_end = !def_->ends.empty()};
        result.statics = static_result(simulation_.model(), state, state.stage);
        End end = find_end();
        while (state.cycle < end_ && !end.is_met && !broken_off_)
        {
            if (!state.statics_due)  // else the run was broken off below
                end = advance();
            if (!end.is_met && state.cycle % finish_every == 0)
                simulation_.finish_by_statics();
            show(simulation_, observers_, state.cycle == end_ || end.is_met);
            broken_off_ = keeper_ != nullptr && !keeper_->keep(simulation_);
        }
        result.ended_by = end.by;
        result.value = end.value;
        result.at_rest = end.by == ended_by::rest || end.by == ended_by::nothing_more;
        result.cycles = state.cycle - begin_;
        result.time = state.time;
        result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        if (broken_off_)
            return result;
        result.to_come = what_goes_on(simulation_.model(), state, result.at_rest);
        if (result.cycles >= least_cycles_checked || def_ == &simulation_.model().stages.back())
            simulation_.check_state();
        if (result.sought_rest && !result.met_end())
            result.not_at_rest = blocks_not_at_rest(simulation_);
        for (Observer* const observer : observers_)
            observer->end_stage(simulation_.model(), state);
        return result;
    }

    [[nodiscard]] bool broken_off() const { return broken_off_; }

    /// Within the static solution of a stage: the run is left where that began.
    StageResult leave()
    {
        broken_off_ = true;
        static_cast<void>(keeper_->keep(simulation_));
        const State& state = simulation_.state();
        return {.name = simulation_.model().stages[state.stage].name,
                .first_cycle = state.stage_begin_cycle,
                .cycles = state.cycle - state.stage_begin_cycle};
    }

  private:
    struct End
    {
        bool is_met = false;
        std::int64_t by = ended_by::limit;
        double value = 0.0;
    };

    /// To the next cycle that somebody wants to see. Does the stage end there?
    End advance()
    {
        const State& state = simulation_.state();
        const std::int64_t now = state.cycle;
        simulation_.advance(next_stop(now) - now);
        pace_.took(state.cycle - now);
        const bool looks = state.cycle % check_every == 0;
        if (looks)
            simulation_.check_state();
        if (ends_at_rest(*def_) && (looks || state.cycle == end_))
            simulation_.hold_lost_blocks();
        return find_end();
    }

    /// Looks at the rock if this is a cycle for it. What a case asks for comes before rest.
    End find_end()
    {
        const ConvergenceDef& criteria = simulation_.model().convergence;
        const std::int64_t cycle = simulation_.state().cycle;
        if ((!ends_at_rest(*def_) && def_->ends.empty()) || cycle == begin_ || cycle % criteria.check_every != 0)
            return {};
        const bool is_steady = !is_load_to_change();
        const bool is_late = cycle - begin_ >= criteria.least_cycles;
        if (!def_->ends.empty())
            if (const auto met = simulation_.look_at_ends(is_steady && is_late))
                return {true, met->end, met->value};
        // The criterion every_block must have held for some time: each check is remembered.
        const bool rests = is_steady && (ends_at_rest(*def_) || waits_for_motion()) && simulation_.check_rest();
        if (!rests || !is_late)
            return {};
        return {true, ends_at_rest(*def_) ? ended_by::rest : ended_by::nothing_more};
    }

    /// Do all ends of the stage need something to move that forces move? Then rest is an end too: nothing can happen any more.
    [[nodiscard]] bool waits_for_motion() const
    {
        const auto needs_motion = [](const StageEndDef& end) { return !end.is_settling() && !end.is_by_clock(); };
        return std::ranges::all_of(def_->ends, needs_motion) && !is_driven(simulation_.model(), simulation_.state());
    }

    /// Does a load or a side change later in this stage, or do excavated blocks still act? The rock is at rest only after that.
    [[nodiscard]] bool is_load_to_change() const
    {
        const State& state = simulation_.state();
        return are_forces_released(simulation_.model(), state) || state.cycle < steady_from(simulation_.model(), state);
    }

    [[nodiscard]] std::int64_t next_stop(std::int64_t now) const
    {
        const ConvergenceDef& criteria = simulation_.model().convergence;
        std::int64_t next = std::min(end_, next_multiple(now, check_every));
        if (ends_at_rest(*def_) || !def_->ends.empty())
            next = std::min(next, next_multiple(now, criteria.check_every));
        for (const Observer* const observer : observers_)
            next = std::min(next, observer->next_cycle(now));
        return keeper_ == nullptr ? next : std::min({next, now + pace_.cycles(), keeper_->next_cycle(now)});
    }

    Simulation& simulation_;
    std::span<Observer* const> observers_;
    Keeper* keeper_;
    Pace pace_;
    const StageDef* def_ = nullptr;
    std::int64_t begin_ = 0;
    std::int64_t end_ = 0;
    bool broken_off_ = false;
};

/// Results of the stages before the present one, from the checkpoint they went through.
std::vector<StageResult> earlier_results(const Model& model, const State& state)
{
    std::vector<StageResult> results;
    std::int64_t begin = 0;
    State then;  // as the stage ended, as far as cycles and stages go
    then.stage_begun = true;
    then.statics = state.statics;
    for (std::size_t i = 0; i < state.stages_done.size(); ++i)
    {
        const StageOutcome& outcome = state.stages_done[i];
        const auto stage = static_cast<Index>(i);
        const StageDef& def = model.stages[i];
        then.stage = stage;
        then.stage_begin_cycle = begin;
        then.cycle = begin + outcome.cycles;
        results.push_back({.name = def.name,
                           .first_cycle = begin,
                           .cycles = outcome.cycles,
                           .sought_rest = ends_at_rest(def),
                           .sought_end = !def.ends.empty(),
                           .at_rest = outcome.at_rest,
                           .ended_by = outcome.ended_by,
                           .value = outcome.value,
                           .time = outcome.time,
                           .to_come = what_goes_on(model, then, outcome.at_rest),
                           .not_at_rest = blocks_of_stage(state.not_at_rest, stage),
                           .statics = static_result(model, state, stage)});
        begin += outcome.cycles;
        then.stages_done.push_back(outcome);
    }
    return results;
}

StageOutcome outcome_of(const StageResult& result)
{
    return {.cycles = result.cycles,
            .at_rest = result.at_rest,
            .ended_by = result.ended_by,
            .value = result.value,
            .time = result.time};
}
}  // namespace

std::vector<Index> blocks_not_at_rest(const Simulation& simulation)
{
    const Model& model = simulation.model();
    std::vector<Index> moving;
    for (const Index block : model.slot_of_user)
        if (simulation.state().blocks.is_free(block) && !is_supported(block, model, simulation.state()))
            moving.push_back(model.user_number[block]);
    return moving;
}

std::vector<StageResult> run_stages(Simulation& simulation, std::span<Observer* const> observers, Keeper* keeper,
                                    const StagePart& part)
{
    const State& state = simulation.state();
    std::vector<StageResult> results = earlier_results(simulation.model(), state);
    bool goes_on = state.stage_begun && part.over == nullptr;
    if (!state.stage_begun)
        show(simulation, observers, true);
    StageRunner runner(simulation, observers, keeper);
    const auto stages = static_cast<Index>(simulation.model().stages.size());
    simulation.ask_in_statics([keeper] { return keeper != nullptr && keeper->is_to_stop(); });
    simulation.follow_statics(
        [keeper](int iterations, double ratio)
        {
            if (keeper != nullptr)
                keeper->follow_statics(iterations, ratio);
        });
    Index first = state.stage;
    if (part.over != nullptr)
    {
        results.push_back(*part.over);
        if (++first < std::min(stages, part.end))
            simulation.note_outcome(outcome_of(results.back()), results.back().not_at_rest);
    }
    for (Index i = first; i < std::min(stages, part.end) && !runner.broken_off(); ++i)
    {
        const auto begun = std::chrono::steady_clock::now();
        try
        {
            if (!goes_on)
                simulation.begin_stage(i);
            else if (state.cycle == state.stage_begin_cycle)
                simulation.solve_due_statics();
            goes_on = false;
            for (Observer* const observer : observers)
                observer->begin_stage(simulation.model(), state);
            results.push_back(runner.run(begun));
        }
        catch (const BrokenOff&)
        {
            results.push_back(runner.leave());
        }
        if (i + 1 < std::min(stages, part.end) && !runner.broken_off())
            simulation.note_outcome(outcome_of(results.back()), results.back().not_at_rest);
    }
    return results;
}
}  // namespace hdem
