#include "parallel/stages.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hdem
{
namespace
{
constexpr std::int64_t check_every = 1000;

void show(Simulation& simulation, std::span<Observer* const> observers, bool all)
{
    for (Observer* const observer : observers)
        if (all || observer->next_cycle(simulation.state().cycle - 1) == simulation.state().cycle)
            observer->observe(simulation.model(), simulation.state());
}

/// How many cycles take about a fifth of a second: so long a keeper may wait.
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
    StageResult run()
    {
        const State& state = simulation_.state();
        const auto begun = std::chrono::steady_clock::now();
        def_ = &simulation_.model().stages[state.stage];
        begin_ = state.stage_begin_cycle;
        end_ = last_cycle(*def_, begin_, simulation_.model().time_step);
        StageResult result{.name = def_->name, .first_cycle = begin_, .until_converged = def_->until_converged};
        result.converged = has_converged();
        while (state.cycle < end_ && !result.converged && !broken_off_)
        {
            const std::int64_t now = state.cycle;
            simulation_.advance(next_stop(now) - now);
            pace_.took(state.cycle - now);
            if (state.cycle % check_every == 0 || state.cycle == end_)
                simulation_.check_state();
            result.converged = has_converged();
            show(simulation_, observers_, state.cycle == end_ || result.converged);
            broken_off_ = keeper_ != nullptr && !keeper_->keep(simulation_);
        }
        result.cycles = state.cycle - begin_;
        result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        if (broken_off_)
            return result;
        simulation_.check_state();
        for (Observer* const observer : observers_)
            observer->end_stage(simulation_.model(), state);
        return result;
    }

    [[nodiscard]] bool broken_off() const { return broken_off_; }

  private:
    [[nodiscard]] bool has_converged() const
    {
        const ConvergenceDef& criteria = simulation_.model().convergence;
        const std::int64_t cycle = simulation_.state().cycle;
        return def_->until_converged && cycle - begin_ >= std::max<std::int64_t>(criteria.least_cycles, 1) &&
               cycle % criteria.check_every == 0 && is_converged(criteria, simulation_.equilibrium());
    }

    [[nodiscard]] std::int64_t next_stop(std::int64_t now) const
    {
        const ConvergenceDef& criteria = simulation_.model().convergence;
        std::int64_t next = std::min(end_, next_multiple(now, check_every));
        if (def_->until_converged)
            next = std::min(next, std::max(begin_ + criteria.least_cycles, next_multiple(now, criteria.check_every)));
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
    for (std::size_t i = 0; i < state.stages_done.size(); ++i)
    {
        const StageOutcome& outcome = state.stages_done[i];
        const StageDef& def = model.stages[i];
        results.push_back({def.name, begin, outcome.cycles, def.until_converged, outcome.converged, 0.0});
        begin += outcome.cycles;
    }
    return results;
}
}  // namespace

bool is_converged(const ConvergenceDef& criteria, const Equilibrium& now)
{
    for (const std::string& criterion : criteria.criteria)
    {
        const bool holds = criterion == "kinetic_energy" ? now.kinetic_energy < now.kinetic_energy_at(criteria.mean_speed)
                                                         : now.unbalanced_force_ratio() < criteria.unbalanced_force_ratio;
        if (!holds)
            return false;
    }
    return !criteria.criteria.empty();
}

std::int64_t last_cycle(const StageDef& stage, std::int64_t begin, double time_step)
{
    if (stage.until_converged)
        return begin + stage.max_cycles;
    if (stage.cycles)
        return begin + *stage.cycles;
    return begin + static_cast<std::int64_t>(std::ceil(stage.duration.value_or(0.0) / time_step * (1.0 - 1e-12)));
}

std::vector<StageResult> run_stages(Simulation& simulation, std::span<Observer* const> observers, Keeper* keeper)
{
    const State& state = simulation.state();
    std::vector<StageResult> results = earlier_results(simulation.model(), state);
    bool goes_on = state.stage_begun;
    if (!goes_on)
        show(simulation, observers, true);
    StageRunner runner(simulation, observers, keeper);
    const auto stages = static_cast<Index>(simulation.model().stages.size());
    for (Index i = state.stage; i < stages && !runner.broken_off(); ++i)
    {
        if (!goes_on)
            simulation.begin_stage(i);
        goes_on = false;
        for (Observer* const observer : observers)
            observer->begin_stage(simulation.model(), state);
        results.push_back(runner.run());
        if (i + 1 < stages && !runner.broken_off())
            simulation.note_outcome(results.back().converged);
    }
    return results;
}
}  // namespace hdem
