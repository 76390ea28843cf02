#include "parallel/stages.h"

#include <algorithm>
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

StageResult run_stage(Simulation& simulation, Index number, std::span<Observer* const> observers)
{
    const StageDef& def = simulation.model().stages[number];
    const ConvergenceDef& criteria = simulation.model().convergence;
    simulation.begin_stage(number);
    for (Observer* const observer : observers)
        observer->begin_stage(simulation.model(), simulation.state());
    const std::int64_t begin = simulation.state().cycle;
    const std::int64_t end = last_cycle(def, begin, simulation.model().time_step);
    StageResult result{.name = def.name, .first_cycle = begin, .until_converged = def.until_converged};
    while (simulation.state().cycle < end && !result.converged)
    {
        const std::int64_t now = simulation.state().cycle;
        std::int64_t next = std::min(end, next_multiple(now, check_every));
        if (def.until_converged)
            next = std::min(next, std::max(begin + criteria.least_cycles, next_multiple(now, criteria.check_every)));
        for (const Observer* const observer : observers)
            next = std::min(next, observer->next_cycle(now));
        simulation.advance(next - now);
        if (next % check_every == 0 || next == end)
            simulation.check_state();
        result.converged = def.until_converged && next - begin >= criteria.least_cycles && next % criteria.check_every == 0 &&
                           is_converged(criteria, simulation.equilibrium());
        show(simulation, observers, next == end || result.converged);
    }
    simulation.check_state();
    for (Observer* const observer : observers)
        observer->end_stage(simulation.model(), simulation.state());
    result.cycles = simulation.state().cycle - begin;
    return result;
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

std::vector<StageResult> run_stages(Simulation& simulation, std::span<Observer* const> observers)
{
    std::vector<StageResult> results;
    show(simulation, observers, true);
    const auto stages = static_cast<Index>(simulation.model().stages.size());
    for (Index i = 0; i < stages; ++i)
        results.push_back(run_stage(simulation, i, observers));
    return results;
}
}  // namespace hdem
