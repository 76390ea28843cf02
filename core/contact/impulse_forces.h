#pragma once
/// What the impulses of a cycle leave behind: forces J / dt, the history of their points, and their work.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Book the work of the cycle's forces along the change of velocity by impulses, half a step of each force, as work of gravity and as impulse loss.
/// Call it before impulses are added to the forces.
void add_impulse_work(const Model& model, const std::vector<ImpulsePoint>& points, const Blocks& blocks, EnergyLedger& ledger);

/// Impulses count as forces J / dt, Eqs. (29), (30): store them as the points' history. Bonds at their strength break.
void store_impulses(const Model& model, const Blocks& blocks, const std::vector<ImpulsePoint>& points, Contacts& contacts);

/// Add the same forces to the blocks' sums, also to those of blocks that cannot move. Not for two threads at once.
void add_impulse_forces(const std::vector<ImpulsePoint>& points, Blocks& blocks);
}  // namespace hdem
