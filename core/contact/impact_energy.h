#pragma once
/// Impacts of blocks that touch in several points give no energy.

#include "core/state/blocks.h"
#include "core/state/workspace.h"

#include <functional>
#include <vector>

namespace hdem
{
/// Energy that the impulses of this cycle take at the points of a group [J]: the sum of J (v_m* + v_m) / 2 - J_S (v_t* + v_t) / 2, v* before and v after all
/// of them. Below 0, impulses give energy. `points` are all that touch the blocks of the group; their impulses count from count_from_zero's pull.
[[nodiscard]] double energy_taken(const std::vector<ImpulsePoint*>& points, const Blocks& blocks);

/// Scales the velocities by which impacts of a group part (ImpulsePoint::target) down, all by the same share, until its impulses give no energy.
///
/// Newton's restitution, point by point, may give energy where blocks hit with friction or in several points at once (T. R. Kane, Stanford Mechanics
/// Alumni Club Newsletter, 1984): up to a fifth of that of the impact where a heavy block wedges a light one. With a share of 0 impacts are plastic,
/// which always takes energy. It is found by halving, to 1/1000 (a greater parting velocity is taken to give more energy). Without a gain,
/// nothing changes.
/// @param solve  finds impulses for other targets; returns the energy that the change takes [J]
/// @return energy that the change takes [J]
double restrain_impacts(const std::vector<ImpulsePoint*>& points, const Blocks& blocks, const std::function<double()>& solve);
}  // namespace hdem
