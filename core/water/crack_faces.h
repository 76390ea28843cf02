#pragma once
/// Do the lines of a water-filled crack lie on faces of blocks? Where they do not, their water presses on nothing.

#include "core/model/model.h"
#include "core/state/blocks.h"

#include <vector>

namespace hdem
{
/// Share of each straight piece of a line on which a face of a block lies.
/// @param line    as drawn, local coordinates [m]
/// @param blocks  as drawn
[[nodiscard]] std::vector<double> shares_on_faces(const std::vector<Vec2>& line, const Model& model, const Blocks& blocks);

/// The part of a crack in which water stands, from its foot up. Empty where there is none.
[[nodiscard]] std::vector<Vec2> wet_part(const WaterCrack& crack, const Vec2& up);
}  // namespace hdem
