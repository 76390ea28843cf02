#pragma once
/// What a case's loads do: forces, prescribed velocities, and their work.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Forces of the case's loads that act in this cycle, in `external`, one entry a block, on top of `constant` ones (none: empty). `before` receives the
/// velocities of the loaded blocks, load by load, for add_load_work.
void apply_loads(const Model& model, std::int64_t cycle, const Blocks& blocks, const std::vector<Triple>& constant,
                 std::vector<Triple>& external, std::vector<LoadedBlock>& before);

/// Set the velocities that loads prescribe in this cycle (zero again once they end). Before the contacts are evaluated, so that a shear
/// spring sheared at a given velocity answers to the displacement at the end of the cycle.
void prescribe_motions(const Model& model, std::int64_t cycle, Blocks& blocks, EnergyLedger& ledger);

/// Work of these loads, once the velocities are updated.
void add_load_work(const Model& model, std::int64_t cycle, const Blocks& blocks, const std::vector<LoadedBlock>& before,
                   EnergyLedger& ledger);
}  // namespace hdem
