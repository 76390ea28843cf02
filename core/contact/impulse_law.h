#pragma once
/// Impulse-based law: contact points in the impulse regime change velocities at once.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// List the points of `range` that are in the impulse regime: collision masses (Eq. 16), approach velocity v_m, strength, and overlap to be corrected.
/// Appends to `points` in the order of the contacts. Call it before the velocities are updated.
/// The load of the last cycle would press the springs by some overlap (remaining_force). Only what is beyond it is corrected, so that a contact keeps
/// its deflection as it changes between springs and impulses. A joint that dilates is to part by what its slip has opened.
void collect_impulse_points(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                            std::vector<ImpulsePoint>& points);

/// The approach velocity that each point must be left with. Call it once the velocities v* hold this cycle's forces, before any impulse.
///
///   target = min(0, -R v_m + max(0, v_m* - v_m))  if approaching (v_m > 0), else 0     after [Lee2025] Eq. (15)
///   excess overlap += u (-target) / v_m           if the point has closed in the last cycle (0 < u <= v_m dt)
///
/// Where slip closes a dilatant joint, velocities count from that at which the blocks follow it.
///
/// R applies once, to the velocity v_m that the blocks have before this cycle's forces. Differs from the paper in two points:
/// - Forces act after the impact: what they press together is no part of the impact, and is not thrown back. R applied to v_m* would throw a resting block
/// up by R g dt in each cycle. Forces that part the blocks do not count, else needles gain energy.
/// - The impact was up to a cycle ago, u / v_m. The way by which the blocks should have parted since is added to the overlap taken back. Without it
/// flights are too short by up to a cycle.
void aim_impulses(const Blocks& blocks, std::vector<ImpulsePoint>& points);

/// Do blocks hit each other at the point, faster than weight and the step make them meet? The same before and after aim_impulses.
[[nodiscard]] bool is_impact(const ImpulsePoint& p);

/// Begin with the impulses of the contacts' last forces, F dt. The impulses of a stack at rest then hold from cycle to cycle, and the springs' share
/// between two points is kept. After an impact the full start would add energy: then it is scaled by the factor that minimises the remaining work.
/// In rock with in-situ stress all points must be started together (`are_stressed`): the forces of one part alone are far from balance.
/// @return energy lost, as for sweep_impulses [J]
double start_impulses(const std::vector<std::vector<ImpulsePoint>*>& lists, bool are_stressed, Blocks& blocks);

/// One sweep over the points, one contact after another: each brings its own approach velocities to their targets and its
/// sliding velocities to zero, within what the joint bears. The normal impulses of a contact's two points are solved together.
///
///   J   <- max(0, J + m_cN (v_m - target)),   v += J n / m,  w += (u x n) J / I     [Lee2025] Eqs. (15)-(18)
///   J_S <- J_S - m_cS v_t,  |J_S| <= J tan(phi) + c L dt                             [Lee2025] Eqs. (9), (10)
///
/// J accumulates over the sweeps, so a later sweep may take back what an earlier one gave too much.
/// Differs from the paper: Eq. (18) is printed with m_A where the moment of inertia belongs. And one impulse after another would send all of a
/// resting face's load to one of its ends.
/// Lists that are swept at the same time must not share a block.
/// @return energy lost: the work of the impulses, taken with the mean of the velocities before and after each [J]
double sweep_impulses(std::vector<ImpulsePoint>& points, Blocks& blocks);

/// Count the impulses from 0 again. Call it once all impulses of the cycle are found. A joint that bears tension allows J >= -T L dt. During the solution
/// its impulses are counted from that pull, and its cohesion is that at the pull, so that the cone of friction has its tip at 0.
void count_from_zero(std::vector<ImpulsePoint>& points);
}  // namespace hdem
