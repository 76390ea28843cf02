#pragma once
/// The contact stage of a cycle: overlaps, regime and force of a range of contacts.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Reads:  motion and inertia of the blocks; features and history of the contacts in `range`.
/// Writes: history (forces and regimes) and staleness of these contacts, their entries in `loads`.
/// Contacts do not depend on each other: any split into ranges gives the same bits.
///
/// Steps 1-3 of a cycle: overlap, length and relative velocity from the stored features (Eq. 3), regime (Eqs. 24-28),
/// spring forces (Eqs. 5-10). A point in the impulse regime gets no spring force here: core/contact/impulse_law.h.
void evaluate_contacts(IndexRange range, const Model& model, Method method, const Blocks& blocks, Contacts& contacts, ContactLoads& loads);

/// Add the loads of `range` to the blocks, in the order of the contacts.
/// Reads: loads, regimes. Writes: force of the blocks that the contacts of `range` touch; adds to `ledger`.
void accumulate_loads(IndexRange range, const Contacts& contacts, const ContactLoads& loads, std::vector<BlockForce>& force, EnergyLedger& ledger);
}  // namespace hdem
