#pragma once
/// [water] of a case -> water of the model.

#include "core/check.h"
#include "core/model/case_def.h"
#include "core/model/model.h"

#include <vector>

namespace hdem
{
/// @param origin  of the model in the user's coordinates
/// @param blocks  as drawn, with those free that a stage frees
/// @pre the model has its gravity, joints, excavations and sizes
[[nodiscard]] std::vector<Problem> resolve_water(const CaseDef& def, const Vec2& origin, const Blocks& blocks, Model& model);
}  // namespace hdem
