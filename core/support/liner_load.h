#pragma once
/// What acts on a liner.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/support/liner_solver.h"

namespace hdem
{
/// Where the rock behind one end of a segment is.
/// @pre  there is a block behind it
[[nodiscard]] Vec2 place_of_rock(const LinerSegment& segment, int end, const Blocks& blocks);

/// Load of a liner in this cycle.
[[nodiscard]] LinerLoad load_of(const Liner& liner, const LinerRecord& record, const LinerMemory& memory, const Model& model,
                                const State& state);

/// The same with the rock where it was in the cycle before: it has moved on since.
[[nodiscard]] LinerLoad last_load(const Liner& liner, const LinerRecord& record, const LinerMemory& memory, const Model& model,
                                  const State& state);
}  // namespace hdem
