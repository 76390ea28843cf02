#pragma once
/// Constant forces of tractions on sides, and of water.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <vector>

namespace hdem
{
/// Force on a block by a traction that is linear along a face, as at its two ends, at the block's centroid.
///
///   F_1 = L (2 t_1 + t_2) / 6,  F_2 = L (t_1 + 2 t_2) / 6,  M = sum of (x - centroid) x F
///
/// @param first, second  traction on the block at `face.from` and `face.to` [Pa]
[[nodiscard]] BoundaryForce force_of_traction(const BoundaryFace& face, const Vec2& first, const Vec2& second);

/// Constant forces on present blocks in the state's stage, one entry a block; empty where no traction acts.
[[nodiscard]] std::vector<Triple> constant_forces(const Model& model, const State& state);

/// The same added to `forces`, which may be empty: then it stays so if there are none.
void add_constant_forces(const Model& model, const State& state, std::vector<Triple>& forces);

/// Work of constant forces along the way from one pose to another.
[[nodiscard]] double work_of(const std::vector<Triple>& given, const std::vector<BlockMotion>& from,
                             const std::vector<BlockMotion>& to);

/// First half of the work of these forces over a step, with the velocities before it; `pushed` lists the blocks.
/// They count to where the blocks are, also on those that come to rest in this cycle (motion/rest.cpp).
void add_work_before(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const Blocks& blocks,
                     EnergyLedger& ledger);

/// Second half, once the velocities of the step are final.
void add_work_after(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const Blocks& blocks,
                    EnergyLedger& ledger);
}  // namespace hdem
