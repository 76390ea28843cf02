#pragma once
/// Which blocks may form groups that move together.

#include "core/model/model.h"
#include "core/state/blocks.h"

#include <limits>
#include <vector>

namespace hdem
{
struct GroupRule
{
    double speed = std::numeric_limits<double>::infinity();  ///< blocks that are faster, or their rims [m/s]
    bool seeks_rest =
        false;  ///< then blocks that roll and piles that tip are damped, and slow blocks that fast ones drag along are not
    double loose_distance = std::numeric_limits<double>::infinity();  ///< blocks that moved farther in their stage may creep [m]
};

/// Free to move in all directions, and to turn.
[[nodiscard]] bool is_unbound(const BlockInertia& inertia);

[[nodiscard]] bool is_fast(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks);

/// Is it fast, present and unbound?
[[nodiscard]] bool may_group(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks);

/// Blocks of `range` that may form groups, ascending. Appends to `fast`.
void find_fast(IndexRange range, const Model& model, const GroupRule& rule, const Blocks& blocks, std::vector<Index>& fast);
}  // namespace hdem
