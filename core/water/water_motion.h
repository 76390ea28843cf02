#pragma once
/// Blocks that move in water: how long its forces hold, for which pose they are found, and the drag on floating blocks.
///
/// A block that floats swings up and down, because its force changes with its place. Forces that are held for n cycles lag behind the motion by half of
/// these cycles, and the swing would grow. So they are found for the pose half way,
///
///   x + v n dt / 2
///
/// with which a swing keeps its size: drift, kick and drift of n cycles are one step of a symplectic scheme, stable while omega n dt < 2. Here
///
///   omega^2 <= rho_w g (2 R / m + (2 R)^3 / (12 I))        heave and roll, R: radius of the block
///
/// and omega n dt <= 0.3 for blocks that float and for such as move.
/// @see verification/unit/core/water/floating_blocks_test.cpp

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// How a stage treats what moves in water.
struct WaterRule
{
    std::int64_t while_floating = 500;  ///< forces hold for at most so many cycles while a block floats
    double drag = 0.0;                  ///< of what floats, as a share of the critical damping at omega [-]
};

/// Greatest angular frequency at which water lets a block swing; 0 without water [1/s].
[[nodiscard]] double swing_rate(Index block, const Model& model);

/// Does water alone carry the block: no contact point acts on it, nor on the group with which it moves?
[[nodiscard]] bool floats(Index block, const State& state);

/// Add the drag on a block to `force`.
/// @param share  WaterRule::drag
void add_drag(Index block, double share, const Model& model, const State& state, Triple& force);

/// The cycle up to which forces of water that are found now hold.
[[nodiscard]] std::int64_t water_holds_until(const Model& model, const State& state, const WaterRule& rule);

/// Where a block is after some time, if it goes on as now.
[[nodiscard]] BlockMotion moved_on(BlockMotion pose, double time);
}  // namespace hdem
