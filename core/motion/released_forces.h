#pragma once
/// What excavated blocks have given to those that stay, taken off over some cycles of the stage; and the weight of rock without stress, put on likewise.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Keep the forces of all contacts between a removed block and one that stays, summed block by block, in State::released. What blocks removed now were given
/// before is forgotten. Forces are those of the last cycle; of impulses J / dt.
/// @param removed  1 for each block that goes
/// @pre    the contacts are still those of before the excavation
void release_forces(const std::vector<std::uint8_t>& removed, State& state);

/// What the water of the stage before gave, and that of the stage that begins does not: to the forces that the stage takes off over its relax_cycles.
void release_water(const std::vector<Triple>& before, State& state);

/// Weight, tractions on sides and water of rock that begins without stress, turned round: so they grow from nothing over the relax_cycles of the first stage. All
/// at once they are felt up to 1.33 times under the default damping, and what breaks or slips by that does not go back.
void hold_back_loads(const Model& model, State& state);

/// The cycle from which on nothing is left of them, or the stage's relax_to.
[[nodiscard]] std::int64_t released_until(const Model& model, const State& state);

/// Do they become less from cycle to cycle?
[[nodiscard]] bool are_forces_released(const Model& model, const State& state);

/// What is left of them now becomes F_0 of the stage that follows.
void keep_released_forces(const Model& model, State& state);

/// No force on their blocks in `external` but the `constant` ones (none: empty): before loads and released forces are put there.
void clear_released_forces(const State& state, const std::vector<Triple>& constant, std::vector<Triple>& external);

/// What is left of them in this cycle, added to `external`, one entry a block. In the n-th cycle of the stage
///
///   F = (r + (1 - r) (1 - n / relax_cycles)) F_0      in the axes of the model, at the centroid, with their moment about it
///
/// r is relax_to, 0 as a rule.
/// `before` receives the velocities of their blocks, for add_released_work.
void apply_released_forces(const Model& model, const State& state, std::vector<Triple>& external, std::vector<Triple>& before);

/// Their work, once the velocities are updated.
void add_released_work(const Model& model, const std::vector<Triple>& before, State& state);
}  // namespace hdem
