#pragma once
/// Impulse-based law: contact points in the impulse regime change velocities at once.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// List the points of `range` that are in the impulse regime, with collision masses (Eq. 16), the approach velocity v_m of each, and the overlap
/// to be corrected. Appends to `points` in the order of the contacts. Call it before the velocities are updated.
/// Overlap is corrected beyond what the load of the last cycle would press into the springs (remaining_force), so that a contact coming from
/// the force regime, or going there, keeps its deflection.
void collect_impulse_points(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                            std::vector<ImpulsePoint>& points);

/// The approach velocity that each point must be left with. Call it once the velocities v* hold this cycle's forces, before any impulse.
///
///   target = min(0, -R v_m + max(0, v_m* - v_m))  if approaching (v_m > 0), else 0     after [Lee2025] Eq. (15)
///   excess overlap += u (-target) / v_m           if the point has closed in the last cycle (0 < u <= v_m dt)
///
/// R applies once, whatever the number of sweeps, to the velocity v_m that the blocks have before this cycle's forces. These act after the impact, but
/// do not press the blocks together again. Differs from the paper:
/// - R applied to v_m* throws a resting block up by R g dt each cycle; with forces left out blocks rise too fast, by g dt. Forces that part the blocks are
///   left out (counted, they let hybrid needles gain 6 % of their energy).
/// - the impact was up to a cycle ago, u / v_m, and since then the blocks have moved on as if it had not been: the way they should have moved apart by now is
///   added to the overlap taken back. Without it flights are too short by up to a cycle.
/// With both, errors of the velocity in a bounce are a third (verification/README.md).
void aim_impulses(const Blocks& blocks, std::vector<ImpulsePoint>& points);

/// Begin with the impulses that the contacts' last forces amount to, F dt: those of a stack at rest then hold from cycle to cycle, and the
/// springs' share between two points is handed over as it is. After an impact they are far too great, more than the sweeps may take back: then only
/// the share of all of them that leaves least to do, which adds no energy.
/// Of rock with in-situ stress all points must be started together (`are_stressed`): without those of its neighbours the forces of one part are far from balance.
/// @return energy lost, as for sweep_impulses [J]
double start_impulses(const std::vector<std::vector<ImpulsePoint>*>& lists, bool are_stressed, Blocks& blocks);

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
}  // namespace hdem
