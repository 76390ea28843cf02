#pragma once
/// Do linings still move?

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// Has it no rock to hold on any more? It falls, and nothing catches it.
[[nodiscard]] bool has_come_off(const Liner& liner, const LinerRecord& record, const Blocks& blocks);

/// Has a lining that still hangs on the rock a node that is faster than `speed` [m/s]? One that has come off falls for ever: nothing waits for it.
[[nodiscard]] bool liners_move(const Model& model, const State& state, double speed);
}  // namespace hdem
