#pragma once
/// Loads of a case: forces, prescribed velocities, and their work.

#include "core/model/model.h"
#include "core/motion/damping.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Find from and until of all loads [cycles]; to be done anew when the model's time step has changed.
void time_loads(Model& model);

/// Factor of a load in the last cycle; 0 where the load did not act.
[[nodiscard]] double last_factor_of(const Load& load, const Model& model, const State& state);

/// Forces of the case's loads that act in this cycle, in `external`, one entry a block, on top of `constant` ones (none: empty). `before` receives the
/// velocities of the loaded blocks, load by load, for add_load_work.
void apply_loads(const Model& model, const State& state, const std::vector<Triple>& constant, std::vector<Triple>& external,
                 std::vector<LoadedBlock>& before);

/// Add to `forces`, one entry a block, the forces in this cycle of the loads that still act so many cycles later.
void add_lasting_loads(const Model& model, const State& state, std::int64_t cycles, std::vector<Triple>& forces);

/// Set the velocities that loads prescribe in this cycle (zero again once they end). Before the contacts are evaluated, so that a shear
/// spring sheared at a given velocity answers to the displacement at the end of the cycle.
void prescribe_motions(const Model& model, State& state);

/// The motion of all held blocks, as seen in this cycle. None where they do not move as one body, or where one of them is held in part.
[[nodiscard]] SupportMotion support_motion(const Model& model, const State& state);

/// Work of these loads, once the velocities are updated.
void add_load_work(const Model& model, const std::vector<LoadedBlock>& before, State& state);

/// Ascending numbers of the blocks on which a load acts in the state's stage or later.
[[nodiscard]] std::vector<Index> loaded_blocks(const Model& model);
}  // namespace hdem
