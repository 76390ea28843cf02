#pragma once
/// Which edges of a block meet in a corner, across its parts.

#include "core/model/model.h"

namespace hdem
{
/// Part of the block that has an edge.
[[nodiscard]] Index part_of(const Shapes& shapes, Index block, Index edge);

/// The edge of the block that meets another one at its end, or at its start, and the part which has it.
struct EdgeNeighbour
{
    Index edge, part;
};

[[nodiscard]] EdgeNeighbour neighbour_of(const Shapes& shapes, Index part, Index edge, bool at_end);
}  // namespace hdem
