#pragma once
/// Loose blocks that creep.

#include "core/motion/fast_blocks.h"
#include "core/state/state.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// Local damping stops swings: it opposes the velocity by a share of the net force, whose sign changes as often. A block that goes one way while it vibrates on its springs is
/// braked in each half of a vibration. The brake may be as great as what drives it: fallen blocks that slide or turn on each other then creep for up to 100 s (core/tried.md).
///
/// So, where rest is sought, blocks are looked at every 256 cycles. A loose block (GroupRule::loose_distance) below the speed of moving groups that goes on in the direction of the look before,
///
///   d . d' > 0.5 |d| |d'|    d = (x, y, turn times radius) between two looks
///
/// in four looks in succession creeps. It is not damped for up to 16 looks, as long as it goes on so. Then it has to creep for four looks again: a slow swing of a large heap, which also
/// goes one way for so long, is damped for a fifth of the time. Standing rock is damped in any case.
[[nodiscard]] bool looks_for_creep(std::int64_t cycles_of_stage);

[[nodiscard]] bool creeps(const CreepingBlock& block);

/// Take a look at all blocks.
/// @param bolted  blocks with other forces between them than those of contacts, which are left as they are
/// @param slow  loose slow blocks, ascending
void watch_creep(const Model& model, const GroupRule& rule, const Blocks& blocks, const std::vector<Index>& bolted,
                 std::vector<CreepingBlock>& slow);

/// Mark those that creep for damping, once forces are summed. Writes: force of these blocks.
void mark_creeping(IndexRange range, const std::vector<CreepingBlock>& slow, Blocks& blocks);
}  // namespace hdem
