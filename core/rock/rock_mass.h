#pragma once
/// Joint sets and outlines -> blocks.

#include "core/check.h"
#include "core/geometry/convex_part.h"
#include "core/geometry/polygon.h"
#include "core/model/case_def.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem
{
/// An edge of a block on a side of the domain; it runs anticlockwise around the domain.
struct SideEdge
{
    Index boundary = no_index;  ///< number of the [[boundary]] of that side
    Vec2 from = {0.0, 0.0};     ///< [m]
    Vec2 to = {0.0, 0.0};
};

/// A wall behind an edge of the domain, for a [[boundary]].
struct RockWall
{
    SideEdge edge;          ///< of the domain
    std::size_t block = 0;  ///< position among the blocks
};

/// A rigid block as cut: a union of convex parts that share internal edges.
struct RockBlock
{
    std::string name;
    std::string material;
    std::vector<ConvexPart> parts;
    Index excavation = no_index;  ///< number of the excavation it lies in, or no_index
    bool fix_x = false;
    bool fix_y = false;
    bool fix_rotation = false;
    Vec2 velocity = {0.0, 0.0};     ///< [m/s]
    double angular_velocity = 0.0;  ///< [rad/s]
    std::vector<SideEdge> sides;    ///< its edges on sides with a [[boundary]]
};

struct RockMass
{
    std::vector<RockBlock> blocks;  ///< walls last
    std::vector<RockWall> walls;
    double domain_area = 0.0;         ///< of the generated domain [m2], 0 without one
    std::int64_t joints = 0;          ///< traces drawn
    std::int64_t cuts = 0;            ///< block cuts made
    std::int64_t refused_cuts = 0;    ///< because a piece or an edge would have been too small
    std::int64_t skipped_cuts = 0;    ///< by persistence
    std::int64_t dead_ends = 0;       ///< stretches of traces that part nothing, dropped
    std::int64_t merged_slivers = 0;  ///< outline pieces joined to a neighbour
    std::vector<DrawnSet> sets;       ///< of each joint set, then of the Voronoi cells and of the traces of a file, if given
    std::vector<Problem> warnings;
};

/// Area, centroid and polar second moment of a block.
AreaMoments moments(const RockBlock& block);

/// [m2]
double area(const RockBlock& block);

/// Fill the domain, cut it along every joint of every set, cut the excavation outlines, merge slivers, add the explicit blocks.
/// The same definition gives the same blocks, bit for bit, on every platform.
/// Throws InputError with all problems of the definition's geometry.
RockMass generate_rock_mass(const CaseDef& def);
}  // namespace hdem
