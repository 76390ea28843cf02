#pragma once
/// What is wrong with a polygon a user gave.

#include "core/types.h"

#include <string>

namespace hdem
{
/// Of one polygon: a star of so many, whose parts all lie near each other, is cut up and looked after in some seconds, a comb in 0.1 s.
inline constexpr std::size_t most_vertices = 25'000;

/// Value, reason and remedy, ready to follow "object: polygon: "; empty for a simple polygon with an area.
std::string polygon_error(const Polygon& polygon);
}  // namespace hdem
