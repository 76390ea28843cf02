#pragma once
/// Blocks in flight take longer steps than the rest of the model.

#include "core/model/model.h"
#include "core/state/energy_terms.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <vector>

namespace hdem
{
/// Blocks of `range` that move freely and have nothing near them: no contact is tracked, nearer than the margins (core/detection/contact_tracking.h).
void find_flying(IndexRange range, const BlockContacts& list, const Blocks& blocks, std::vector<Index>& flying);

/// After a cycle: each of these blocks that has moved farther than `loose_distance` in its stage goes on for k - 1 more steps of the same length under its weight,
///
///   v' = v + (k - 1) g dt,   x' = x + (k - 1) v dt + k (k - 1) / 2 g dt^2,
///
/// the same places and velocities as after k cycles. k is the greatest whole number up to 4096 for which the block uses up at most a tenth
/// of its margin. Nothing acts on it but its weight, so that a state of rest does not depend on when the block flies. Blocks that it comes near to are
/// found in time, and from then on it moves step by step like all others. The times of outputs are those of the others.
/// @return  greatest share of its margin that a block has used
double fly_ahead(const std::vector<Index>& flying, double loose_distance, const Model& model, Blocks& blocks, EnergyLedger& ledger);
}  // namespace hdem
