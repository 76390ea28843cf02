#pragma once
/// Which parts of a concave block bear what another block has of it.

#include "core/detection/facing_edges.h"

namespace hdem
{
/// Does this pair of parts bear what the blocks have in common?
///
/// Not where it is nearer to being apart across an internal edge than across any external one, and a pair of parts around it bears and frees it when drawn apart: then it
/// lies in the part beyond that edge. Here an external edge on the far side of the block may seem to be pressed, by as much as the block is thick: behind a thin ear a
/// neighbour would be shot away. (A pair that bears in another direction, as along the other leg of an angle, does not hold a spike here.)
///
/// But all of them may leave it to each other, as where a spike has come into a block at the seam of two parts, or past a hollow corner. Then the pair bears in which the
/// blocks lie deepest, if its external edge is not on the far side; else the spike would go on through the block.
///
/// Nor does a pair bear that touches with a corner of which another part has the edge that lies on the other block (as where a step lies flush on a block, and a seam ends
/// in its lower corner).
/// @param tolerance  by which distances may differ, and be taken for equal, until features are searched again [m]
/// @see verification/unit/core/detection/concave_blocks_test.cpp
[[nodiscard]] bool bears(const Shapes& shapes, const PartPair& pair, const PairScan& scan, const Facing& its_facing,
                         double tolerance);
}  // namespace hdem
