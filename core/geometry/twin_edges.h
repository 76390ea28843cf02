#pragma once
/// Internal edges of blocks that are made of convex parts.

#include "core/geometry/convex_part.h"

#include <vector>

namespace hdem
{
/// For each edge of a block, part after part: by how many places the same edge of the neighbouring part lies from it. 0: not an internal edge, or no part has
/// the same two ends.
[[nodiscard]] std::vector<Index> twin_edges(const std::vector<ConvexPart>& parts);
}  // namespace hdem
