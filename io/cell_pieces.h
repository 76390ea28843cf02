#pragma once
/// Convex pieces of a cell with holes.

#include "core/geometry/polygon.h"

#include <vector>

namespace hdem
{
/// @param outside  anticlockwise
/// @return  nothing where pieces that fill the cell are not found, as round-off leaves no way to a hole
[[nodiscard]] std::vector<Polygon> pieces_of_cell(const Polygon& outside, const std::vector<Polygon>& holes);
}  // namespace hdem
