#pragma once
/// Which damping acts on a block, by the contacts it has in this cycle.

#include "core/model/case_def.h"
#include "core/state/blocks.h"

#include <cmath>

namespace hdem
{
/// Damping coefficients of one block in one cycle.
struct BlockDamping
{
    double local = 0.0;   ///< alpha of Eqs. (13), (14) [-]
    double global = 0.0;  ///< alpha_d of Eqs. (20), (21) [1/s]
};

/// Conditional damping, [Lee2025] sect. 3.3 (whose equation numbers are swapped in print):
///
///   at least one impulse contact:  global damping, alpha_d = 2 xi_g omega_avg, Eqs. (20)-(22)
///   only force contacts:           local damping, alpha, Eqs. (11)-(14)
///   no contact:                    none
///
/// Presets: `paper` is just that. `dynamic` has no local damping. `automatic` scales local damping by the share of shear strength that
/// the block's joints have left, and so leaves a sliding block alone:
///
///   alpha_effective = alpha (1 - max |F_S| / F_max)
///
/// Sliding is motion, not vibration; full local damping would let a block slide at (1 - alpha) of its acceleration. Fading rather
/// than switching at the onset of slip matters: while the shear spring takes up load the block is about to move, and damping it
/// until it slips costs 0.6 % of the way of the first second on a slope (no damping at all gains 0.9 to 1.6 %; faded 0.16 % at most).
[[nodiscard]] inline BlockDamping conditional_damping(const BlockForce& acting, DampingPreset preset, const DampingDef& damping)
{
    if ((acting.contacts & contact_impulse) != 0)
        return {.local = 0.0, .global = 2.0 * damping.global_damping_ratio * damping.average_frequency};
    if ((acting.contacts & contact_force) == 0 || preset == DampingPreset::dynamic)
        return {};
    return {.local = damping.local * (preset == DampingPreset::automatic ? 1.0 - static_cast<double>(acting.mobilised) : 1.0), .global = 0.0};
}

/// Force left of `force` once local damping has opposed the motion:
///
///   F - alpha |F| sgn(v)                                             [Lee2025] Eqs. (11)-(14)
///
/// per component, with F the *net* force on the block, gravity and loads included. (With the sum of the contacts' absolute
/// forces, the other reading of Eq. (13), the exact static force is never reached.)
[[nodiscard]] inline double locally_damped(double force, double velocity, double alpha)
{
    const double sign = velocity > 0.0 ? 1.0 : (velocity < 0.0 ? -1.0 : 0.0);
    return force - alpha * std::abs(force) * sign;
}
}  // namespace hdem
