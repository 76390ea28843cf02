#pragma once
/// From far out of balance to near it: Newton's iteration and cycles in turn.

#include "parallel/static_solver.h"

namespace hdem
{
/// Do the contacts bear less than half of the weight? Then nearly all of them will close, slip or open.
[[nodiscard]] bool is_unloaded(const Model& model, const State& state);

/// Bring `state` near to balance: a few iterations of Newton, then a few hundred damped cycles by springs, in turn, until the unbalanced ratio of the cycles is
/// small. Each does what the other cannot. Newton carries a load through the whole model in one step, but where all points change at once it does
/// not find which of them open and slip. Cycles find that in a few hundred, but take thousands to carry a load across a large model (core/tried.md).
///
/// Velocities are 0 afterwards; cycle, time, method and step are as before, and contacts have forces. The ledger holds what the cycles booked.
/// @return  false if it does not come near, or a block goes too deep into another
/// @pre  velocities 0, no impulse points
bool approach_balance(const Model& model, State& state, int threads, const StaticRule& rule, StaticOutcome& outcome);

/// All free blocks stand still, and all take part.
void stop_all(Blocks& blocks);
}  // namespace hdem
