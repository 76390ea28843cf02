#pragma once
/// Impulses and position correction of a cycle: sweep after sweep, in each colour after colour.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"
#include "parallel/partition.h"

namespace hdem
{
class Team;

/// Changes velocities of the blocks, gives the pseudo velocities of this cycle, books the energies of both and stores impulses as forces, Eqs. (15)-(19),
/// (29), (30).
/// @param impulses  points in the impulse regime in this cycle
/// @pre  all threads of the team are here; velocities hold all other forces
void apply_impulses(const Model& model, ExactIslands exact, State& state, const Team& team, Index impulses, Partition& partition,
                    Workspace& work);
}  // namespace hdem
