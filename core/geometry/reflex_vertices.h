#pragma once
/// Reflex corners of blocks that are made of convex parts.

#include "core/geometry/convex_part.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// Which vertices of a block, part after part, lie in a corner of more than 180 degrees: there the angles of several parts add up.
/// A part ends there, the block does not.
[[nodiscard]] std::vector<std::uint8_t> reflex_vertices(const std::vector<ConvexPart>& parts);
}  // namespace hdem
