#pragma once
/// Which contacts exist: from candidate pairs to the list of contacts, history carried over.

#include "core/detection/cell_list.h"
#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// Distance two parts may be apart and still be tracked as a contact [m].
[[nodiscard]] double skin_width(const Model& model);

/// Boxes of the parts in `range` at the blocks' poses, widened by half the skin; empty for excavated blocks.
void compute_boxes(IndexRange parts, const Model& model, const Blocks& blocks, std::vector<Box>& boxes);

/// Greatest way that a block of `range` has moved since the rebuild (turning counts with its radius) [m]. Contacts must be found anew once it
/// exceeds half of the skin: two blocks may each use up half of it.
[[nodiscard]] double greatest_move(IndexRange range, const Model& model, const Blocks& blocks,
                                   const std::vector<BlockMotion>& rebuilt_at);

/// New contacts from `pairs` (ascending keys): features are searched, pairs farther apart than the skin are left out,
/// contacts that `old` already has (same parts, ascending) keep their features and history. Appends to `out` in key order.
void track_contacts(IndexRange pairs_range, const std::vector<std::uint64_t>& pairs, const Model& model, const Blocks& blocks,
                    const Contacts& old, std::vector<Contact>& out, EnergyLedger& ledger);

/// Search the features of the stale contacts of `range`; what that does to the energy of their springs goes to `ledger`.
/// @return how many were searched
Index refresh_features(IndexRange range, const Model& model, const Blocks& blocks, Contacts& contacts, EnergyLedger& ledger);
}  // namespace hdem
