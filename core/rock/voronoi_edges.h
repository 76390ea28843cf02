#pragma once
/// [voronoi]: cells around random points as lines to cut.

#include "core/model/case_def.h"

#include <vector>

namespace hdem
{
/// Edges of the Voronoi cells in the domain and the region.
///
/// Points are uniform in a box around, some cells larger. Points without iterations (a Poisson process) have cells of mean edge
/// 2 / (3 sqrt(lambda)) (Moller 1994, Lectures on random Voronoi tessellations); where they move to the centroids of their cells
/// (Lloyd 1982), edges come out shorter: then the number of points is corrected once by the mean edge that was found. Edges shorter than
/// generator.smallest_edge shrink to one point.
///
/// The diagram is that of Boost.Polygon: points are whole numbers of 2^-30 of the box, and its decisions are exact.
/// @pre find_rock_problems has none
[[nodiscard]] std::vector<SourceLine> draw_voronoi(const CaseDef& def, DrawnSet& drawn);

/// An estimate of the number of cells.
[[nodiscard]] double count_cells(const CaseDef& def);
}  // namespace hdem
