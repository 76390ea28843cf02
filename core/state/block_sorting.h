#pragma once
/// Blocks brought back into the order of a space-filling curve, once their motion has spoilt it.

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// Do contacts reach for blocks far away in memory? True when more than a quarter of the contacts between movable blocks join blocks that stand
/// more than 1000 places apart; along the curve it is a tenth at most. Models of fewer than 5000 blocks fit a cache in any order.
[[nodiscard]] bool is_order_decayed(const Model& model, const State& state);

/// Sort blocks along the Hilbert curve at their present places, and all that refers to them. Users' names and numbers stay, contacts keep their history.
/// Contacts must be found anew before the next cycle.
void sort_blocks(Model& model, State& state);
}  // namespace hdem
