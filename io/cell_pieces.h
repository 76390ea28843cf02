#pragma once
/// Convex pieces of a cell with holes.

#include "core/geometry/polygon.h"
#include "io/geos.h"

#include <vector>

namespace hdem
{
/// By hdem's own decomposition; should its pieces not fill the cell, by the Delaunay triangles of the library, which finds none for some cells.
/// @return  nothing where neither fills it
[[nodiscard]] std::vector<Polygon> pieces_of_cell(const Geos& geos, const GEOSGeometry* cell, const Polygon& outside,
                                                  const std::vector<Polygon>& holes);
}  // namespace hdem
