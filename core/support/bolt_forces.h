#pragma once
/// Forces of bolts in a cycle, from the places of the blocks.
///
///   anchored   T = K (d - d_0 - e_p),  0 <= T <= yield               d distance of its two ends, d_0 that without force [m]
///   local      axial likewise, |T| <= yield, across the active length; shear  Q = K_s (u_s - u_0 - u_p),  |Q| <= shear_strength,
///              u_s the part of the distance of its two ends that is square to the bolt, which turns with the blocks
///   grouted    grouted_bolt.h; a joint opens by what the distance of two points beside it grows, one diameter of the bar away from it on each side
///
/// The two blocks of a link get opposite forces on one line, so that momentum and angular momentum are kept. A bolt that is installed remembers where its ends are:
/// it has no force but its pretension.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Forces of the bolts in this cycle, in their order, with the velocities before the step. Also finds what slips, yields and ruptures.
///
/// A block on a bolt that touches others by impulses has no other damping of its swinging along the bolt. There the links are damped by
///
///   c = 2 damping (K m / n)^1/2        K stiffness of the link   m collision mass of its two blocks along it   n links at the block that has most
///
/// times the speed at which its ends part. Both blocks get opposite forces, so that momentum is kept: blocks that slide or fall together are not held. With the
/// damping, the bolt pulls no less than 0 and no more than its strength. The energy that damping takes is booked as local damping.
/// @param damping  share of the critical one; 0: none
void pull_bolts(const Model& model, State& state, double damping, std::vector<BlockPush>& pushes);

/// Before loads are added: forget the forces of the last cycle.
void clear_bolt_forces(const std::vector<BlockPush>& pushes, const std::vector<Triple>& constant, std::vector<Triple>& external);
void add_bolt_forces(const std::vector<BlockPush>& pushes, std::vector<Triple>& external);

/// Let bolts count in the damping of the blocks of `range`: their reserve adds to that of joints, but not while a joint slides. A block that hangs on bolts alone, though it may touch others,
/// counts as held by springs along the first bolt that pulls; else it would swing for ever. Blocks whose bolts are at their strength are not held: they
/// fall as they would without damping.
void hold_by_bolts(const std::vector<BlockPush>& pushes, IndexRange range, Blocks& blocks);

/// Work of the bolts over the step, once the velocities are final.
void add_bolt_work(const std::vector<BlockPush>& pushes, const Blocks& blocks, EnergyLedger& ledger);
}  // namespace hdem
