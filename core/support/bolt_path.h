#pragma once
/// Which blocks a straight line runs through, as drawn.

#include "core/model/model.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// A stretch of the line inside one block.
struct PathPiece
{
    Index block = no_index;
    double from = 0.0;  ///< along the line [m]
    double to = 0.0;
};

/// Stretches of the line from `from` to `to` in local coordinates, in their order. Where the line runs along a joint, the block with the lower number of the user has it.
/// @param skipped  per block: does it not count?
/// @pre  blocks are as drawn
[[nodiscard]] std::vector<PathPiece> pieces_along(const Vec2& from, const Vec2& to, const Model& model, const Blocks& blocks,
                                                  const std::vector<std::uint8_t>& skipped);
}  // namespace hdem
