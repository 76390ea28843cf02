#pragma once
/// Internal edges of blocks that are made of convex parts.

#include "core/geometry/convex_part.h"

#include <vector>

namespace hdem
{
/// For each edge of a block, part after part: in how many steps from its place the same edge of the part beyond it stands. 0: not an internal edge, or no part has
/// the same two ends.
[[nodiscard]] std::vector<Index> twin_edges(const std::vector<ConvexPart>& parts);
}  // namespace hdem
