#pragma once
/// Which contacts exist: from candidate pairs to the list of contacts, history carried over.

#include "core/detection/cell_list.h"
#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// Distance two blocks at rest may be apart and still be tracked as a contact [m].
[[nodiscard]] double skin_width(const Model& model);

/// How far any point of a block moves in the next cycle, at most [m].
[[nodiscard]] double way_a_cycle(Index block, const Model& model, const Blocks& blocks);

/// Give each block its margin: half the skin, and for fast blocks the distance they move in the next 64 cycles, at most eight times as much. Two blocks are tracked
/// as a contact when their distance is less than the sum of their margins. With one margin for all, a single falling block would cause a search for all
/// contacts every few cycles.
void set_margins(const Model& model, Blocks& blocks);

/// Boxes of the parts in `range` at the blocks' poses, widened by the block's margin; empty for excavated blocks.
void compute_boxes(IndexRange parts, const Model& model, const Blocks& blocks, std::vector<Box>& boxes);

/// Greatest share of its margin that a block of `range` has moved since the rebuild; turning counts with its radius. Contacts must be found anew once it
/// exceeds 1.
[[nodiscard]] double margin_used(IndexRange range, const Model& model, const Blocks& blocks,
                                 const std::vector<BlockMotion>& rebuilt_at);

/// New contacts from `pairs` (ascending keys): features are searched, pairs farther apart than their margins are left out. Contacts that `old` already has
/// (same parts) keep their history; contacts between blocks at rest, which have not moved, keep their features as well. Contacts that touch and move are
/// searched: their energy depends on it (core/tried.md). Appends to `out` in key order.
/// @param old_order  numbers of the contacts of `old` by ascending keys, of order_by_parts
void track_contacts(IndexRange pairs_range, const std::vector<std::uint64_t>& pairs, const Model& model, const Blocks& blocks,
                    const Contacts& old, const std::vector<Index>& old_order, std::vector<Contact>& out, EnergyLedger& ledger);

/// Search the features of the stale contacts of `range`; what that does to the energy of their springs goes to `ledger`.
/// @return how many were searched
Index refresh_features(IndexRange range, const Model& model, const Blocks& blocks, Contacts& contacts, EnergyLedger& ledger);
}  // namespace hdem
