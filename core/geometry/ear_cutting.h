#pragma once
/// Simple polygon -> triangles.

#include "core/geometry/convex_split.h"

#include <vector>

namespace hdem
{
/// Sine of an angle below which a vertex counts as straight: round-off of a vertex put on an edge.
inline constexpr double straight_sine = 1e-12;

/// Triangles of a simple polygon, in the order in which they are cut off: always the ear whose new edge is shortest. Edges of the polygon stay
/// whole and keep their tags; new ones are internal, without chord.
///
/// An ear is a vertex that turns left, with no other vertex in its triangle. Candidates wait in a queue, shortest first. One that is no ear
/// waits for the vertex that it found in its triangle, and is tried again when that one turns left. Only vertices that do not turn left are
/// looked for, in an R-tree: n log n for the polygons people draw.
/// @pre the polygon is anticlockwise, and simple but for vertices and internal edges at which it touches itself
/// @see  verification/unit/core/geometry/convex_decomposition_test.cpp
std::vector<CutPolygon> cut_ears(const CutPolygon& polygon);
}  // namespace hdem
