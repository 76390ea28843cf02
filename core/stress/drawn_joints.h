#pragma once
/// Cohesion and in-situ stress: joints have them from the start, contacts that are made later do not.

#include "core/detection/edge_touch.h"
#include "core/model/model.h"
#include "core/state/state.h"

#include <vector>

namespace hdem
{
/// Do two edges lie on each other, up to a gap of the length floor at either end? Two that only meet in a corner do not, whichever side of it round-off puts them.
[[nodiscard]] inline bool lie_on_each_other(const EdgeTouch& touch, double length_floor)
{
    return touch.length > closed_gap * length_floor && -std::min(touch.point[0].overlap, touch.point[1].overlap) < length_floor;
}

/// Preload of a point of a joint that has cohesion or tension until it breaks [m]. It closes the point as drawn, even where round-off leaves a gap. Otherwise
/// the least gap would break a joint without tension.
[[nodiscard]] double drawn_preload(const Model& model, Index law, double overlap, double length_floor);

/// Give contacts between blocks of `among` (one entry a block) the cohesion of their joints where their edges lie on each other, and the forces of [insitu].
/// Every other contact has neither: blocks that have met since the start stick nowhere. Otherwise a block that breaks off and falls back would be held again.
/// Differs from the paper, whose contacts all have the joint's cohesion.
/// @see verification/unit/core/stress/drawn_joints_test.cpp
void join_drawn_blocks(const Model& model, const std::vector<std::uint8_t>& among, State& state);
}  // namespace hdem
