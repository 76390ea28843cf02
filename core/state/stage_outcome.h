#pragma once
/// What is told of stages at the end of a run, also after a restart. Blocks go by the user's numbers: they may be sorted anew in between.

#include "core/types.h"

#include <cstdint>

namespace hdem
{
/// How a stage ended.
struct StageOutcome
{
    std::int64_t cycles = 0;
    bool at_rest = false;
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
