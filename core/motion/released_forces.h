#pragma once
/// Forces of excavated blocks on those that stay, removed over some cycles of the stage; and loads of rock that begins without stress, applied likewise.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Keep the forces of all contacts between a removed block and one that stays, summed block by block, in State::released. Released forces on blocks that
/// are removed now are dropped. Forces are those of the last cycle; of impulses J / dt.
/// @param removed  1 for each block that goes
/// @pre    the contacts are still those of before the excavation
void release_forces(const std::vector<std::uint8_t>& removed, State& state);

/// Add the water forces of the stage before, less those of the stage that begins, to the forces that the stage removes over its relax_cycles.
void release_water(const std::vector<Triple>& before, State& state);

/// Release the weight, loads, tractions on sides, water and the forces of bolts, with opposite sign. So they grow from nothing over the relax_cycles of a stage whose
/// springs are empty: the first one of rock without [insitu], and one that follows impulses. Applied at once, they would act up to 1.33 times under the default
/// damping, and what breaks or slips by that does not go back.
/// @param tensioned  forces of the bolts at the start of the stage
void hold_back_loads(const Model& model, const std::vector<BlockPush>& tensioned, State& state);

/// Cycle from which on none of the released forces is left, or only the stage's share relax_to.
[[nodiscard]] std::int64_t released_until(const Model& model, const State& state);

/// Do the released forces decrease from cycle to cycle?
[[nodiscard]] bool are_forces_released(const Model& model, const State& state);

/// What is left of the released forces now becomes F_0 of the stage that follows.
void keep_released_forces(const Model& model, State& state);

/// Reset `external` on the blocks with released forces to the `constant` forces (none: empty). Call it before loads and released forces are added.
void clear_released_forces(const State& state, const std::vector<Triple>& constant, std::vector<Triple>& external);

/// Add what is left of the released forces in this cycle to `external`, one entry a block. In the n-th cycle of the stage
///
///   F = (r + (1 - r) (1 - n / relax_cycles)) F_0      in the axes of the model, at the centroid, with their moment about it
///
/// r is relax_to, 0 as a rule.
/// `before` receives the velocities of their blocks, for add_released_work.
void apply_released_forces(const Model& model, const State& state, std::vector<Triple>& external, std::vector<Triple>& before);

/// Work of the released forces, once the velocities are updated.
void add_released_work(const Model& model, const std::vector<Triple>& before, State& state);
}  // namespace hdem
