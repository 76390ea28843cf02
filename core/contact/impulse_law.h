#pragma once
/// Impulse-based law: contact points in the impulse regime change velocities at once.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// List the points of `range` that are in the impulse regime, with collision masses (Eq. 16), the approach velocity each must
/// be left with, and the overlap to be corrected. Appends to `points` in the order of the contacts.
///
///   target = -R v_m  if approaching (v_m > 0), else 0                          [Lee2025] Eq. (15)
///
/// Call it before the velocities are updated: R applies once, whatever the number of sweeps, to the velocity that the
/// blocks have before this cycle's gravity. (Applied to the velocity after it, a resting block is thrown up by R g dt each
/// cycle and creeps out of its contact.) Overlap is corrected beyond what the last cycle's force would press into the
/// springs, so that a contact coming from the force regime, or going there, keeps its deflection.
void collect_impulse_points(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                            std::vector<ImpulsePoint>& points);

/// Begin with the impulses that the contacts' last forces amount to, F dt: those of a stack at rest then hold from cycle to cycle, and the
/// springs' share between two points is handed over as it is. After an impact they are far too great, more than the sweeps may take back: then only
/// the share of all of them that leaves least to do, which adds no energy.
/// @return energy lost, as for sweep_impulses [J]
double start_impulses(std::vector<ImpulsePoint>& points, Blocks& blocks);

/// One sweep over `range` of the points, one contact after another: each brings its own approach velocities to their targets and its
/// sliding velocities to zero, within what the joint carries. The normal impulses of a contact's two points are solved together.
///
///   J   <- max(0, J + m_cN (v_m - target)),   v += J n / m,  w += (u x n) J / I     [Lee2025] Eqs. (15)-(18)
///   J_S <- J_S - m_cS v_t,  |J_S| <= J tan(phi) + c L dt                             [Lee2025] Eqs. (9), (10)
///
/// J accumulates over the sweeps, so a later sweep may take back what an earlier one, or the start, gave too much.
/// Differs from the paper: Eq. (18) is printed with m_A where the moment of inertia belongs; one impulse after another sends all of a
/// resting face's load to one of its ends.
/// Two contacts of a range must not share a block with contacts of a range handled at the same time.
/// @return energy lost: the work of the impulses, taken with the mean of the velocities before and after each [J]
double sweep_impulses(std::vector<ImpulsePoint>& points, Blocks& blocks);

/// One sweep of the position correction: pseudo velocities, added to positions but never to velocities, take the overlap
/// back. As a real velocity, Eq. (19) to the letter, it would feed energy into every bounce (Table 4 is destroyed).
///
///   P <- max(0, P + m_cN (pv_m + share * (overlap - allowed) / dt))                 after [Lee2025] Eq. (19)
void sweep_correction(const Model& model, const Blocks& blocks, std::vector<ImpulsePoint>& points, std::vector<Triple>& pseudo);

/// Forces of the cycle work along the velocity that the impulses leave, not only along the one they found: book the difference, half a step of
/// each force times the change of velocity, as work of gravity and as impulse loss. Before impulses are added to the forces.
void add_impulse_work(const Model& model, const std::vector<ImpulsePoint>& points, const Blocks& blocks, EnergyLedger& ledger);

/// Impulses count as forces J / dt, Eqs. (29), (30): store them as the points' history.
void store_impulses(const Model& model, const std::vector<ImpulsePoint>& points, Contacts& contacts);

/// Add the same forces to the blocks' sums, those of blocks that cannot move too: no two threads at once.
void add_impulse_forces(const Model& model, const std::vector<ImpulsePoint>& points, std::vector<BlockForce>& force);
}  // namespace hdem
