#pragma once
/// Forces of tractions on sides, and of water.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <vector>

namespace hdem
{
/// Force on a block by a traction that is linear along a face, as at its two ends, at the block's centroid.
///
///   F_1 = L (2 t_1 + t_2) / 6,  F_2 = L (t_1 + 2 t_2) / 6,  M = sum of (x - centroid) x F,  and the sums of (x - centroid) (x) F
///
/// @param first, second  traction on the block at `face.from` and `face.to` [Pa]
[[nodiscard]] BoundaryForce force_of_traction(const BoundaryFace& face, const Vec2& first, const Vec2& second);

/// Factor of a side in the state's cycle [-].
[[nodiscard]] double factor_of(const Boundary& boundary, const Model& model, const State& state);

/// Forces on present blocks in the state's stage and cycle, one entry a block; empty where no traction acts.
[[nodiscard]] std::vector<Triple> constant_forces(const Model& model, const State& state);

/// Blocks on which such forces act in the state's stage, whatever their size in its cycle; ascending.
[[nodiscard]] std::vector<Index> pushed_blocks(const Model& model, const State& state);

/// Add the same forces to `forces`, which may be empty. It stays empty if there are none.
void add_constant_forces(const Model& model, const State& state, std::vector<Triple>& forces);

/// Work of constant forces as the blocks move from one pose to another [J].
[[nodiscard]] double work_of(const std::vector<Triple>& given, const std::vector<BlockMotion>& from,
                             const std::vector<BlockMotion>& to);

/// Book the work of given forces from one pose to another. The parts of the sides and of the water in `state` go to their own terms; the rest,
/// by forces that remain of excavated blocks, counts as work of loads.
void book_given_work(const std::vector<Triple>& given, const Model& model, const State& state, const std::vector<BlockMotion>& from,
                     const std::vector<BlockMotion>& to, EnergyLedger& ledger);

/// First half of the work of these forces over a step, with the velocities before it; `pushed` lists the blocks.
/// The work counts up to the present poses, also for blocks that come to rest in this cycle (motion/rest.cpp).
void add_work_before(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const State& state, EnergyLedger& ledger);

/// Where walls of a side move, make work of the boundary of what update_velocities has booked as work of prescribed motions.
void book_walls(const std::vector<Index>& walls, const Blocks& blocks, EnergyLedger& ledger);

/// Second half, once the velocities of the step are final.
void add_work_after(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const State& state, EnergyLedger& ledger);
}  // namespace hdem
