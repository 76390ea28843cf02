#pragma once
/// What is wrong with a polygon a user gave.

#include "core/types.h"

#include <string>

namespace hdem
{
/// Greatest number of vertices of one polygon. A star with so many, a slow shape, is cut into convex parts in some seconds.
inline constexpr std::size_t most_vertices = 25'000;

/// Value, reason and remedy, ready to follow "object: polygon: "; empty for a simple polygon with an area.
std::string polygon_error(const Polygon& polygon);
}  // namespace hdem
