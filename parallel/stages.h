#pragma once
/// Runs the stages of a case: so many cycles, so long, or until converged.

#include "core/observer.h"
#include "parallel/simulation.h"

#include <span>
#include <string>

namespace hdem
{
struct StageResult
{
    std::string name;
    std::int64_t first_cycle = 0;
    std::int64_t cycles = 0;
    bool until_converged = false;  ///< that was its aim
    bool converged = false;
};

/// Is the rock at rest by all criteria of the case?
[[nodiscard]] bool is_converged(const ConvergenceDef& criteria, const Equilibrium& now);

/// Last cycle the stage may reach, seen from where it begins.
[[nodiscard]] std::int64_t last_cycle(const StageDef& stage, std::int64_t begin, double time_step);

/// Run all stages, showing the state to the observers. The run's state is checked for non-finite values and overlaps at
/// least every thousand cycles.
std::vector<StageResult> run_stages(Simulation& simulation, std::span<Observer* const> observers);
}  // namespace hdem
