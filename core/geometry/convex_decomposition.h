#pragma once
/// Simple polygon -> convex parts, and fewer parts where a union of them is convex.

#include "core/geometry/convex_split.h"

#include <vector>

namespace hdem
{
/// Convex parts of a simple polygon, every one with positive area. Edges of the polygon stay whole and keep their tags; new
/// ones are internal, without chord, and have the same two ends in both parts.
///
/// Ears with the shortest new edge are cut off first, then internal edges are removed, the longest first, as long as the
/// union stays convex: at most four times the least possible number of parts (Hertel, Mehlhorn 1983).
/// @pre the polygon is anticlockwise, and simple but for vertices and internal edges at which it touches itself
std::vector<CutPolygon> convex_parts(const CutPolygon& polygon);

/// Remove internal edges that two parts share end to end, the longest first, as long as the union stays convex. A vertex that
/// becomes straight goes too when both its edges lie on one chord and came from the same source.
/// @param slack  such a vertex may lie this far beside its side: far from the origin, coordinates are rounded [m]
void merge_convex_parts(std::vector<CutPolygon>& parts, double slack = 0.0);

/// Area common to two simple polygons of either orientation, concave or not: the sum over their convex parts [m2].
///
/// Not by boost::geometry::intersection: for polygons that touch along edges collinear up to round-off, as neighbours do here,
/// version 1.74 may return all of one of them.
double overlap_area(const Polygon& a, const Polygon& b);
}  // namespace hdem
