#pragma once
/// Results of stages for the end of a run, also after a restart. Blocks have the user's numbers here, since their order in memory may change in between.

#include "core/types.h"

#include <cstdint>

namespace hdem
{
/// What ended a stage: the number of one of StageDef::ends, or one of these.
namespace ended_by
{
inline constexpr std::int64_t limit = -1;         ///< its cycles, duration or max_cycles were over
inline constexpr std::int64_t rest = -2;          ///< it had converged
inline constexpr std::int64_t nothing_more = -3;  ///< at rest before the end it waited for: nothing can happen any more
}  // namespace ended_by

/// How a stage ended.
struct StageOutcome
{
    std::int64_t cycles = 0;
    bool at_rest = false;
    std::int64_t ended_by = ended_by::limit;
    double value = 0.0;  ///< of the quantity of the end that was met
    double time = 0.0;   ///< of the run, at the end [s]
};

/// Memory of an end of the running stage, from one check to the next.
struct EndWatch
{
    std::int64_t since_cycle = -1;  ///< it has held since then; < 0: it does not
    double since_time = 0.0;        ///< likewise [s]
    double low = 0.0;               ///< of all values since then
    double high = 0.0;
    double axis_x = 0.0;  ///< of a history between two blocks [-]
    double axis_y = 0.0;
    std::int64_t joints = 0;  ///< digest of which joints are open, closed and broken
};

/// A block that a stage names.
struct StageBlock
{
    Index stage = no_index;
    Index block = no_index;  ///< the user's number

    auto operator<=>(const StageBlock&) const = default;
};

/// How a static solution ended.
enum class StaticEnd : std::uint8_t
{
    balanced,
    nearly_balanced,  ///< single blocks rest where the law of a contact jumps: cycles have to settle them
    no_equilibrium,   ///< blocks go on moving however far the search follows them
    not_converged
};

/// A static solution at the beginning of a stage.
struct StaticSolution
{
    Index stage = no_index;
    StaticEnd end = StaticEnd::not_converged;
    int iterations = 0;
    double residual = 0.0;  ///< unbalanced force ratio of what stands [-]
};
}  // namespace hdem
