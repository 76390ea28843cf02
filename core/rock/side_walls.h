#pragma once
/// Which edges of the domain a side is, and the walls behind them.

#include "core/rock/rock_mass.h"

#include <set>
#include <string>
#include <vector>

namespace hdem
{
/// Edges of the anticlockwise `polygon` that lie on one of the `sides` of the box around it, or whose number as given is in `numbers`.
/// @param reversed  the user gave them clockwise
[[nodiscard]] std::set<Index> edges_of(const Polygon& polygon, bool reversed, const std::vector<std::string>& sides,
                                       const std::vector<int>& numbers);

/// Outline of a wall behind an edge of an anticlockwise polygon, anticlockwise; its first edge from the end of that edge to its start.
/// It is longer than the edge where the corner is convex, so that blocks there may slide along it, and ends on the bisector where the corner is concave.
/// @param thickness  [m]
[[nodiscard]] Polygon wall_behind(const Polygon& polygon, std::size_t edge, double thickness);

/// Add a wall behind each edge of each [[boundary]] that needs one: as thick as a block of the mean size, called after the boundary.
/// Throws InputError where a wall would lie in a block, or has the name of one.
/// @param boundary_edges  of the domain, per [[boundary]]
void add_walls(const CaseDef& def, const Polygon& domain, const std::vector<std::set<Index>>& boundary_edges, double mean_size,
               RockMass& rock);
}  // namespace hdem
