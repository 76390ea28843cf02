#pragma once
/// Polygon with holes -> one polygon.

#include "core/geometry/convex_split.h"

#include <optional>
#include <vector>

namespace hdem
{
/// Holes become one polygon with the outside around them, each by an internal edge there and back: the shortest from corner to corner that crosses nothing. cut_ears and
/// convex_parts take such polygons.
/// @pre  the outside is anticlockwise, holes are clockwise, and none of them cross; they may touch in corners
/// @return  nothing where round-off leaves no way to a hole
[[nodiscard]] std::optional<CutPolygon> join_holes(CutPolygon outside, std::vector<CutPolygon> holes);
}  // namespace hdem
