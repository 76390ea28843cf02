#pragma once
/// Vertices that are one point up to round-off become one point, and those on a straight side go.

#include "core/rock/block_cutter.h"

#include <vector>

namespace hdem
{
/// Points nearer to each other than the tolerance become the one with the least x.
/// @return  whether any of them has moved
bool weld_points(std::vector<Vec2*> points, double tolerance);

/// Vertices within an outline's box and nearer to each other than mass.tolerance take the same coordinates.
///
/// Chords make neighbours agree wherever one cut parted them. A point where two outlines or an outline's vertex and a joint happen
/// to meet is computed more than once, in ways that may differ in the last bit.
void weld_vertices(CutMass& mass, const std::vector<Polygon>& outlines);

/// Vertices at which a part goes straight on along one joint or outline are left out, so that its side is one edge: slivers that were merged, and joints
/// that cross several parts of a block, leave some. A contact would bear along one of the edges only.
void drop_straight_vertices(std::vector<CutPolygon>& parts, double tolerance);
}  // namespace hdem
