#pragma once
/// Parts of blocks with one edge on each straight side.

#include "core/geometry/convex_split.h"

#include <vector>

namespace hdem
{
/// A side may be made of two edges in one line, of different sources: a joint and an outline, say. A pair of parts has one contact, of one edge each, so that such a part would bear on one
/// of the two alone where a single edge faces both. It is cut from the vertex between them to the vertex that leaves the most equal areas.
/// @param tolerance  distance of a vertex from a straight side [m]
void split_sides(std::vector<CutPolygon>& parts, double tolerance);
}  // namespace hdem
