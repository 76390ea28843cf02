#pragma once
/// The value of a number of the case at which blocks begin to fail.

#include "parallel/bracket_search.h"
#include "parallel/stages.h"

#include <string>
#include <vector>

namespace hdem
{
/// When a run has failed: a quantity of a block, or the number of detached blocks, passes a limit, at a multiple of 100 cycles or at the end.
struct FailureCondition
{
    enum class Quantity
    {
        displacement,  ///< of the centroid since the first cycle [m]
        rotation,      ///< since the first cycle, its absolute value [deg]
        detached       ///< how many free blocks have moved farther than convergence.detached_distance
    };
    Quantity quantity = Quantity::displacement;
    std::vector<std::string> blocks;  ///< empty: any free block; detached: all
    double limit = 0.0;
};

struct ConditionResult
{
    bool fails = false;
    double greatest = 0.0;  ///< of the quantity
    std::string block;      ///< that has it
    std::int64_t cycles = 0;
    bool met_ends = true;  ///< false: a stage ended at its max_cycles
    /// A stage that sought rest ended without it, and one of the blocks in question was not at rest: it may be on its way to the limit.
    bool still_moves = false;
    bool ends_moving = false;  ///< the same where the last stage sought no rest
    bool was_stopped = false;  ///< by the stop token: no answer
};

/// Runs all stages, or to where the condition is met. Throws RunError as a run does.
[[nodiscard]] ConditionResult run_to_condition(Simulation& simulation, const FailureCondition& condition,
                                               const std::stop_token& stop);

/// Which end of the range stands.
struct CriticalRange
{
    double stands = 0.0, fails = 0.0;
};
/// Between two numbers of which one stands: `stands` may be the greater one.
[[nodiscard]] Bracket search_between(const CriticalRange& range, double tolerance, int threads, const StandsAt& stands,
                                     const AfterPair& after = {});
}  // namespace hdem
