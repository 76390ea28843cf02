#pragma once
/// Loose blocks run ahead of the clock while the rock around them looks for its rest.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// In a stage that runs until it has converged, what is asked for is where blocks come to rest, not when. Nearly all of the rock does so within a few
/// thousand cycles; then most cycles pass while single blocks slide out and fall. Such a block gets a clock of its own, n times as fast:
///
///   m -> m / n^2,  I -> I / n^2,  v -> n v,  w -> n w       weight, springs and friction as they are
///
/// Its path, the work of every force on it, and its kinetic energy stay the same; what takes n cycles takes one. This is the density scaling of
/// quasi-static codes, for loose blocks alone. In `motion` and `inertia` stand the scaled values; Blocks::velocity gives those of the user.
///
/// A block is loose once it has moved more than `loose_distance` since its stage began. Its pace n, a power of two so that scaling is exact, is the
/// greatest, up to 64, for which
///
///   - n w dt <= 1, half of what is stable: w from its mass and the springs of all that touches it or is near;
///   - it moves at most 7.5e-4 of its size a cycle, and with nothing near it 1/20 of the skin;
///   - it comes at most 1/20 nearer to what it is about to hit at more than sqrt(g size) / 10: it hits with its true momentum, at the true step.
///
/// Blocks that touch have the same n; one that sticks to standing rock has n = 1.
///
/// First: what each loose block by itself allows, into `bounds`; 0 for a block that is not loose.
void bound_paces(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks,
                 std::vector<double>& bounds);

/// Second, when all bounds are known.
void update_paces(IndexRange range, const BlockContacts& list, const Contacts& contacts, const std::vector<double>& bounds,
                  bool may_grow, Blocks& blocks);

[[nodiscard]] bool is_pace(double pace);

/// All blocks back to the clock.
void reset_paces(Blocks& blocks);

/// Does the present stage look for a state of rest? Then it runs until it has converged, with hdem's own damping.
[[nodiscard]] inline bool is_relaxing(const Model& model, const State& state)
{
    return state.damping == DampingPreset::automatic && state.stage_begun && model.stages[state.stage].until_converged;
}

/// Cycles between two updates, and between two at which paces may grow: longer than a block swings on its springs, so that one that rocks or
/// jolts stays with the clock.
inline constexpr std::int64_t pace_every = 4;
inline constexpr std::int64_t pace_growth_every = 16;
}  // namespace hdem
