#pragma once
/// Blocks of the rock mass -> blocks of the model.

#include "core/geometry/polygon.h"
#include "core/model/model.h"
#include "core/rock/rock_mass.h"
#include "core/state/state.h"

#include <span>
#include <vector>

namespace hdem
{
/// Moments of one block.
struct BlockMoments
{
    AreaMoments of;
    double radius;  ///< of its farthest vertex, from the centroid [m]
};

/// Where the rock lies.
struct PlacedRock
{
    Box box;                            ///< around it, in the blocks' coordinates
    Vec2 extent;                        ///< width and height [m]
    Vec2 origin;                        ///< of the model in these coordinates
    std::vector<BlockMoments> moments;  ///< one a block, walls included
};

/// The rock without walls of sides.
[[nodiscard]] std::span<const RockBlock> rock_of(const RockMass& rock);

/// Choose the model's origin, and find the moments of all blocks. Rock far from the user's origin is moved to the model's: else every centroid loses digits.
[[nodiscard]] PlacedRock place_rock(RockMass& rock, Model& model);

/// How far the rock extends along a direction; 0 where that is no direction [m].
[[nodiscard]] double extent_along(const Vec2& direction, const RockMass& rock, const PlacedRock& placed);

/// Put all blocks into the model, sorted along a Hilbert curve, and set its mean size.
void add_blocks(const CaseDef& def, const RockMass& rock, const PlacedRock& placed, Model& model);

/// The state in which the blocks begin.
void add_initial_state(const RockMass& rock, const PlacedRock& placed, const Model& model, State& state);

/// Eq. (28): model area over the area of a block, here the mean one. The model's width and height are those of the smallest
/// rectangle around it: along the axes of x and y a turned model would have another threshold.
[[nodiscard]] double size_ratio(const RockMass& rock, const PlacedRock& placed, double mean_size);
}  // namespace hdem
