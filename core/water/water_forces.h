#pragma once
/// Forces of water on blocks.
///
/// On a joint the pressure acts on both faces, over the whole stretch on which the edges face each other, open or closed: springs carry
/// what remains, so that the normal force of a joint law is the effective one. On a free face it acts where water is ponded, but not
/// on faces of drained excavations, nor where a boundary gives the stress. Pressures of a crack act on the faces that lie on its line as drawn, and stay
/// with these faces until their block has moved a quarter of its size.
///
///   F = -integral of p n ds,  M = integral of (x - centroid) x dF      n: out of the block
///
/// A block that is surrounded by standing water loses rho_w g A of its weight, by the divergence theorem.
/// @see verification/unit/core/water/water_forces_test.cpp

#include "core/model/model.h"
#include "core/state/state.h"

#include <array>

namespace hdem
{
/// Forces of water that hold from now until a cycle, in the state's stage (core/water/water_motion.h); one entry a block; empty without water.
/// @param drag  WaterRule::drag
[[nodiscard]] std::vector<Triple> water_forces(const Model& model, const State& state, std::int64_t until, double drag);

/// What the water takes off the normal forces of the two points of a contact: same resultant and moment as its pressure [N].
/// @param from, to  the contact's points, local coordinates [m]
[[nodiscard]] std::array<double, 2> water_share(const Model& model, Index stage, Index law, const Vec2& from, const Vec2& to);
}  // namespace hdem
