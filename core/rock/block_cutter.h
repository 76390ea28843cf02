#pragma once
/// Cutting the domain into blocks along the joints of every set.

#include "core/geometry/convex_decomposition.h"
#include "core/geometry/convex_union.h"
#include "core/rock/joint_sets.h"
#include "core/rock/rock_mass.h"

#include <functional>
#include <vector>

namespace hdem
{
/// A block while the mass is being cut: a connected union of convex parts.
struct CutBlock
{
    std::vector<CutPolygon> parts;
    Index excavation = no_index;  ///< number of the excavation it lies in
    Index outline = no_index;     ///< number of the last excavation whose outline cut it
};

/// All blocks with the chords their edges lie on.
struct CutMass
{
    Chords chords;
    std::vector<CutBlock> blocks;
    std::vector<CutPolygon> domain;  ///< convex parts of the uncut domain
    double tolerance = 0.0;          ///< a line nearer to a vertex goes through it [m]
};

/// Length of joints in the blocks that they met [m].
struct CutLengths
{
    double cut = 0.0;
    double skipped = 0.0;  ///< by persistence
    double refused = 0.0;

    [[nodiscard]] double sum() const { return cut + skipped + refused; }
};

/// One block, the domain. Edge i of the polygon becomes chord i, so that blocks at the domain's boundary know their side.
/// @pre domain is simple and anticlockwise
CutMass uncut_mass(const Polygon& domain, double tolerance);

/// Cut every block in the path of a joint, joint by joint in their order.
///
/// A block is left whole with the chance 1 - persistence (counted in skipped_cuts), and when a piece would be smaller than
/// generator.smallest_block_area or have a new edge shorter than generator.smallest_edge (refused_cuts). A block of several parts is
/// cut or left as one; each connected piece becomes a block.
///
/// Every block looks only at the joints that can reach it: the time is proportional to the number of blocks.
///
/// @param is_meant  blocks for which it says no stay as they are; empty: all are cut
/// @return  how long the joints are in the blocks that they met
CutLengths cut_blocks(CutMass& mass, const JointTraces& joints, const JointSetDef& set, const GeneratorDef& generator,
                      RockMass& counts, const std::function<bool(const CutBlock&)>& is_meant = {});
}  // namespace hdem
