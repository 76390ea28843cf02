#pragma once
/// Position correction: removes the overlap of contact points in the impulse regime.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Velocity at which a point is to part, or, < 0, may be pressed together, by the position correction [m/s].
[[nodiscard]] inline double correction_velocity(const Model& model, const Steps& step, const ImpulsePoint& p)
{
    return (p.excess_overlap > 0.0 ? model.contact.correction_fraction : 1.0) * p.excess_overlap / step.next;
}

/// One sweep of the position correction: pseudo velocities, added to positions but never to velocities, remove the
/// overlap. As a real velocity, Eq. (19) to the letter, it would feed energy into every bounce (Table 4 could not be met).
///
///   P <- max(0, P + m_cN (pv_m + share * excess / dt))                 after [Lee2025] Eq. (19)
///
/// A point that overlaps by less than its load (excess < 0) may be pressed together by that much, and no more: else a needle that is lifted at one end
/// would be turned into the ground with the other, and gain energy there.
void sweep_correction(const Model& model, const Blocks& blocks, std::vector<ImpulsePoint>& points, std::vector<Triple>& pseudo);

/// Work that the position correction of this cycle takes: against the gravity of a range of blocks, and into the normal springs of a range of
/// contacts (shear springs follow velocities only).
void add_correction_gravity(IndexRange range, const Model& model, const Blocks& blocks, const std::vector<Triple>& pseudo,
                            EnergyLedger& ledger);
void add_correction_springs(IndexRange range, const Blocks& blocks, const Contacts& contacts, const std::vector<Triple>& pseudo,
                            EnergyLedger& ledger);
}  // namespace hdem
