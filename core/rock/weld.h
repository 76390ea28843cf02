#pragma once
/// Vertices that are one point up to round-off become one point, and those on a straight side go.

#include "core/rock/block_cutter.h"

#include <vector>

namespace hdem
{
/// Vertices within an outline's box and nearer to each other than mass.tolerance take the same coordinates.
///
/// Chords make neighbours agree wherever one cut parted them. A point where two outlines or an outline's vertex and a joint happen
/// to meet is computed more than once, in ways that may differ in the last bit.
void weld_vertices(CutMass& mass, const std::vector<Polygon>& outlines);

/// Vertices at which a part goes straight on along one joint are left out, so that its side is one edge: a joint that crosses several parts
/// of a block leaves some where parts are put together again, and a contact would bear along one of the edges only.
void drop_straight_vertices(std::vector<CutPolygon>& parts, double tolerance);
}  // namespace hdem
