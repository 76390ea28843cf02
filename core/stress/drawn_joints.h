#pragma once
/// What a joint has from the start and a contact that is made later has not: cohesion, and the stress of the rock.

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

/// By how much a point of a joint is preloaded that has cohesion or tension until it breaks: it is closed as drawn, also where numbers are rounded so that there is a
/// gap. Without tension the least gap would break it. [m]
[[nodiscard]] double drawn_preload(const Model& model, Index law, double overlap, double length_floor);

/// Give contacts between blocks of `among` (one entry a block) the cohesion of their joints where their edges lie on each other, and the forces of [insitu].
/// Every other contact is without both: blocks that have met since the start stick nowhere. A block that breaks off and falls back would be held again otherwise.
/// Differs from the paper, whose contacts all have the joint's cohesion.
/// @see verification/unit/core/stress/drawn_joints_test.cpp
void join_drawn_blocks(const Model& model, const std::vector<std::uint8_t>& among, State& state);
}  // namespace hdem
