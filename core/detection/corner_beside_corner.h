#pragma once
/// Corners that lie beside each other bear nothing, and corners that pass each other do not hit.

#include "core/detection/facing_edges.h"
#include "core/model/model.h"
#include "core/state/blocks.h"

namespace hdem
{
/// Do two parts touch with corners only, so that their overlap says nothing about which side of a corner the other block is on?
///
/// A block that slides over the joint between two others is as deep in the second one as its weight, or what else it bears, presses it in. The side of that joint would hold it, or impulses would
/// throw it back; so would a bevel at the front of the block. So two things bear nothing:
///
///   edges that lie over each other by less than the width (of a shorter edge, by less than half: a tip may be as narrow as it likes)
///   a steep edge that a corner has entered at its end by less than the width, if the edge that meets it there lies flat on the other block and one slides on the other
///
/// What slides into a hollow corner hits the other side of that at once.
///
/// The width is a tenth of the length floor and what blocks may move until the next search, or some settlements of the lighter block under the
/// forces that its sides bear (detection/bearing_force.h), at most a hundredth of the smaller one's size. Impulses leave no settlement.
/// Where rock settles, corners that bear go on bearing: there the width goes by the block's weight alone.
/// @param has_borne  the pair bore before this search
/// @see verification/unit/core/detection/seams_test.cpp
[[nodiscard]] bool is_corner_beside_corner(const Model& model, const Blocks& blocks, const PartPair& pair, const Facing& facing,
                                           bool has_borne);

/// Do the blocks of two parts move past each other faster than by a fall of 1e-4 of their size? Rock that settles is slower.
[[nodiscard]] bool is_sliding(const Model& model, const PartPair& pair, double size);

/// The edges that face each other where a corner slides off the end of an edge that it has only just reached: those of the other side, if the blocks do not approach there. Else `facing`.
///
/// The distance of two parts is the greatest over their sides. Where two sides are equally near, it shrinks as fast as that of the side at which the parts approach least. So a block
/// that slides off the tips of two blocks in one point passes the lower one, though its corner would hit the inclined top of that.
[[nodiscard]] Facing pass_corner(const Model& model, const Blocks& blocks, const PartPair& pair, const PairScan& scan,
                                 const Facing& facing);

/// Is it at the end of one of two pieces of a straight side that the parts lie over each other by less than `width` [m], so that the other piece bears the rest?
[[nodiscard]] bool is_end_of_a_piece(const Shapes& shapes, const PartPair& pair, const Facing& facing, double width);
}  // namespace hdem
