#pragma once
/// Equations of motion: velocities from forces, poses from velocities.

#include "core/model/model.h"
#include "core/motion/damping.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Works of ranges of blocks, lane by lane: see ContactTally.
struct VelocityWorks
{
    LaneSums gravity, holding, local, global, changes, coasting;

    void add_to(EnergyLedger& ledger) const;
};

/// Step 4 of a cycle: velocities at t + dt/2 from the forces at t, with the damping of each block's state.
///
///   v <- v + (F - F_d) dt / m,   w <- w + (M - M_d) dt / I           [Lee2025] Eqs. (11), (12)
///   v <- v (1 - alpha_d dt)                                          [Lee2025] Eqs. (20), (21), first
///
/// Reads force and inertia, writes velocities of the blocks in `range`; adds the work of gravity, of prescribed motions and of
/// damping to `works`, each force times the mean of the velocities before and after.
void update_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works);

/// What blocks do in a cycle: the greatest of each.
struct Travel
{
    double speed_share = 0.0;    ///< speed of the centroid over the block's margin, squared [1/s2]
    double rim_share = 0.0;      ///< speed of the rim by rotation over the margin [1/s]
    double speed_squared = 0.0;  ///< vx^2 + vy^2 + (w radius)^2, without the position correction [m2/s2]

    void take(const Travel& other);
    /// Bound on the share of its margin that any of them uses up.
    [[nodiscard]] double way(double dt) const;
};

/// Step 6: poses from the new velocities (semi-implicit Euler). A turn by w dt is made with the Cayley form, whose result is a unit vector to
/// rounding; its angle is off by (w dt)^3 / 12. The rest of the rounding is taken out by a Newton step towards length 1.
///
/// `pseudo`: velocities of the position correction to be added, one entry a block; used up. Or none.
Travel update_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo = nullptr);
}  // namespace hdem
