#pragma once
/// Cycles counted from the start of a stage.

#include "core/state/state.h"

#include <algorithm>

namespace hdem
{
/// Cycles since the start of a stage, or of the run for no_index; -1 where the stage has not begun.
[[nodiscard]] inline std::int64_t cycles_since(Index stage, const State& state)
{
    if (stage == no_index)
        return state.cycle;
    if (stage > state.stage || (stage == state.stage && !state.stage_begun))
        return -1;
    std::int64_t since = state.cycle - state.stage_begin_cycle;
    for (Index i = stage; i < state.stage && static_cast<std::size_t>(i) < state.stages_done.size(); ++i)
        since += state.stages_done[static_cast<std::size_t>(i)].cycles;
    return since;
}
}  // namespace hdem
