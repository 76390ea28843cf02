#pragma once
/// Which damping acts on a block, by the contacts it has in this cycle.

#include "core/model/case_def.h"
#include "core/state/blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
/// Damping of one block in one cycle.
struct BlockDamping
{
    double local = 0.0;           ///< alpha of Eqs. (13), (14) for translation [-]
    double local_rotation = 0.0;  ///< the same for rotation [-]
    double global = 0.0;          ///< alpha_d of Eqs. (20), (21) [1/s]
    bool along_joint =
        false;  ///< translation is damped along and across the block's most mobilised joint, along it by `reserve` at most
};

/// Conditional damping, [Lee2025] sect. 3.3 (whose equation numbers are swapped in print):
///
///   at least one impulse contact:  global damping, alpha_d = 2 xi_g omega_avg, Eqs. (20)-(22)
///   only force contacts:           local damping, alpha, Eqs. (11)-(14)
///   no contact:                    none
///
/// Presets: `paper` is just that. `dynamic` has no local damping. `automatic` lets local damping hold a block back no more than the
/// friction it has left could: along the joint whose strength is in use most, the damping force is at most the sum of what all its force points
/// have in reserve,
///
///   |F_d,t| <= sum (F_max - |F_S|)
///
/// and rotation is damped by alpha (1 - |F_S| / F_max) of that joint. A sliding block has nothing in reserve and moves freely. A block about
/// to slide moves as on a rigid-plastic joint from the start: net force less reserve is driving force less strength, D - S, whatever
/// its shear springs carry already. (Exact while reserve < alpha |F|, for S up to alpha D. Without damping the springs' late answer gains 0.6 to
/// 0.9 % of the way of the first second on a slope of 30 degrees at phi = 20; alpha fading with the mobilised share lost 0.5 % of Newmark's slide,
/// and left a block that swings on its normal springs undamped.)
[[nodiscard]] inline BlockDamping conditional_damping(const BlockForce& acting, DampingPreset preset, const DampingDef& damping)
{
    if ((acting.contacts & contact_impulse) != 0)
        return {.global = 2.0 * damping.global_damping_ratio * damping.average_frequency};
    if ((acting.contacts & contact_force) == 0 || preset == DampingPreset::dynamic)
        return {};
    const bool automatic = preset == DampingPreset::automatic;
    return {.local = damping.local,
            .local_rotation = automatic ? damping.local * (1.0 - static_cast<double>(acting.mobilised)) : damping.local,
            .along_joint = automatic};
}

/// Force left of `force` once local damping has opposed the motion:
///
///   F - alpha |F| sgn(v)                                             [Lee2025] Eqs. (11)-(14)
///
/// per component, with F the *net* force on the block, gravity and loads included. (With the sum of the contacts' absolute
/// forces, the other reading of Eq. (13), the exact static force is never reached.)
/// @param limit  greatest damping force [N]
[[nodiscard]] inline double locally_damped(double force, double velocity, double alpha,
                                           double limit = std::numeric_limits<double>::infinity())
{
    const double sign = velocity > 0.0 ? 1.0 : (velocity < 0.0 ? -1.0 : 0.0);
    return force - std::min(alpha * std::abs(force), limit) * sign;
}

/// Force on a block's centroid after local damping. A block that can move along one axis only is damped along it.
[[nodiscard]] inline Vec2 locally_damped(const BlockForce& force, const BlockInertia& inertia, double vx, double vy,
                                         const BlockDamping& damping)
{
    if (!damping.along_joint)
        return {locally_damped(force.x, vx, damping.local), locally_damped(force.y, vy, damping.local)};
    const double reserve = std::max(static_cast<double>(force.reserve), 0.0);
    if (inertia.inverse_mass_x == 0.0 || inertia.inverse_mass_y == 0.0)
        return {locally_damped(force.x, vx, damping.local, reserve), locally_damped(force.y, vy, damping.local, reserve)};
    const double t_x = force.t_x;
    const double t_y = force.t_y;
    const double along = t_x * force.x + t_y * force.y;
    const double across = t_x * force.y - t_y * force.x;
    const double drag_t = locally_damped(along, t_x * vx + t_y * vy, damping.local, reserve) - along;
    const double drag_m = locally_damped(across, t_x * vy - t_y * vx, damping.local) - across;
    return {force.x + t_x * drag_t - t_y * drag_m, force.y + t_y * drag_t + t_x * drag_m};
}
}  // namespace hdem
