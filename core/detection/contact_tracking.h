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

/// Give each block its margin: half the skin, for fast ones their way in the next 64 cycles, up to eight times as much. Two blocks are tracked as a contact
/// when they are nearer than their margins together. With one margin for all, a single block that falls has all contacts found anew every few cycles.
void set_margins(const Model& model, Blocks& blocks);

/// Boxes of the parts in `range` at the blocks' poses, widened by the block's margin; empty for excavated blocks.
void compute_boxes(IndexRange parts, const Model& model, const Blocks& blocks, std::vector<Box>& boxes);

/// Greatest share of its margin that a block of `range` has moved since the rebuild; turning counts with its radius. Contacts must be found anew once it
/// exceeds 1.
[[nodiscard]] double margin_used(IndexRange range, const Model& model, const Blocks& blocks,
                                 const std::vector<BlockMotion>& rebuilt_at);

/// New contacts from `pairs` (ascending keys): features are searched, pairs farther apart than their margins are left out. Contacts that `old` already has
/// (same parts) keep their history; those between blocks at rest, which have not moved, their features as well. Appends to `out` in key order.
/// @param old_order  numbers of the contacts of `old` by ascending keys, of order_by_parts
/// Those that touch and move are searched too: their energy depends on it (core/tried.md).
void track_contacts(IndexRange pairs_range, const std::vector<std::uint64_t>& pairs, const Model& model, const Blocks& blocks,
                    const Contacts& old, const std::vector<Index>& old_order, std::vector<Contact>& out, EnergyLedger& ledger);

/// Search the features of the stale contacts of `range`; what that does to the energy of their springs goes to `ledger`.
/// @return how many were searched
Index refresh_features(IndexRange range, const Model& model, const Blocks& blocks, Contacts& contacts, EnergyLedger& ledger);
}  // namespace hdem
