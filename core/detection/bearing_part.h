#pragma once
/// Which parts of a concave block bear the overlap with another block.

#include "core/detection/facing_edges.h"

namespace hdem
{
/// Does this pair of parts bear what the blocks have in common?
///
/// Not if two things hold: the pair overlaps less across an internal edge than across any external one, and a neighbouring pair of parts bears and would
/// free this pair if drawn apart. Then the overlap belongs to the part beyond the internal edge. Otherwise an external edge on the far side of the
/// block could seem to be pressed by the whole thickness of the block: a neighbour behind a thin ear would be shot away. (A neighbouring pair that
/// bears in another direction, as along the other leg of an angle, would not hold a spike here.) Nor does it bear, whatever its internal edges, if it is pressed in
/// deeper than a neighbouring pair that would free it: beside a corner where a seam ends, a part may be as thick as the block is long.
///
/// It may be that all pairs leave the overlap to each other, as where a spike has entered a block at the seam of two parts, or past a reflex corner. Then
/// the pair with the deepest overlap bears, if its external edge is not on the far side. Otherwise the spike would go on through the block.
///
/// A pair does not bear if it touches only with a corner, and the edge at that corner that lies on the other block belongs to another part (as where a
/// step lies flush on a block, and a seam ends in its lower corner).
/// @param tolerance  differences of distances below it count as none until features are searched again [m]
/// @see verification/unit/core/detection/concave_blocks_test.cpp
[[nodiscard]] bool bears(const Shapes& shapes, const PartPair& pair, const PairScan& scan, const Facing& its_facing,
                         double tolerance);
}  // namespace hdem
