#pragma once
/// What is wrong with a polygon a user gave.

#include "core/types.h"

#include <string>

namespace hdem
{
/// Value, reason and remedy, ready to follow "object: polygon: "; empty for a simple polygon with an area.
std::string polygon_error(const Polygon& polygon);
}  // namespace hdem
