#pragma once
/// Generated blocks as polygons to write.

#include "core/rock/rock_mass.h"
#include "io/geojson.h"

#include <vector>

namespace hdem
{
/// All blocks but walls, in their order.
[[nodiscard]] std::vector<BlockShape> block_shapes(const CaseDef& def, const RockMass& rock);
}  // namespace hdem
