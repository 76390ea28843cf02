#pragma once
/// Which damping acts on a block, by the contacts it has in this cycle.

#include "core/model/case_def.h"
#include "core/state/blocks.h"

#include <limits>

namespace hdem
{
/// What damping needs to know of the forces on a block.
template <typename R>
struct BasicActing
{
    R x = 0.0, y = 0.0, moment = 0.0;  ///< net [N], [N m]
    R reserve = 0.0;                   ///< shear strength not in use [N]
    R mobilised = -1.0;                ///< share of the shear strength in use at the joint where it is greatest [-]
    R t_x = 1.0, t_y = 0.0;            ///< direction of that joint [-]
    decltype(R() < R()) springs{};     ///< has contact points in the force regime
    decltype(R() < R()) impulses{};    ///< has contact points in the impulse regime
};
using Acting = BasicActing<double>;

/// Damping of one block in one cycle.
template <typename R>
struct BasicBlockDamping
{
    R local = 0.0;           ///< alpha of Eqs. (13), (14) for translation [-]
    R local_rotation = 0.0;  ///< the same for rotation [-]
    R global = 0.0;          ///< alpha_d of Eqs. (20), (21) [1/s]
    bool along_joint =
        false;  ///< translation is damped along and across the block's most mobilised joint, along it by `reserve` at most
};
using BlockDamping = BasicBlockDamping<double>;

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
///
/// A stage that runs until it has converged is damped as by `paper` under `automatic` too (is_relaxing): what is asked for then is a state of rest
/// close to where the rock began, and a block that swings past it has slipped there. Next to the tunnel blocks move 0.4 mm farther otherwise.
template <typename R>
[[nodiscard]] inline BasicBlockDamping<R> conditional_damping(const BasicActing<R>& acting, DampingPreset preset,
                                                              const DampingDef& damping)
{
    const bool automatic = preset == DampingPreset::automatic;
    const double alpha = preset == DampingPreset::dynamic ? 0.0 : damping.local;
    const R none = 0.0;
    const R local = select(acting.impulses, none, select(acting.springs, R(alpha), none));
    return {.local = local,
            .local_rotation = automatic ? local * (R(1.0) - acting.mobilised) : local,
            .global = select(acting.impulses, R(2.0 * damping.global_damping_ratio * damping.average_frequency), none),
            .along_joint = automatic};
}

/// Force left of `force` once local damping has opposed the motion:
///
///   F - alpha |F| sgn(v)                                             [Lee2025] Eqs. (11)-(14)
///
/// per component, with F the *net* force on the block, gravity and loads included. (With the sum of the contacts' absolute
/// forces, the other reading of Eq. (13), the exact static force is never reached.)
/// @param limit  greatest damping force [N]
template <typename R>
[[nodiscard]] inline R locally_damped(R force, R velocity, R alpha, R limit = std::numeric_limits<double>::infinity())
{
    const R zero = 0.0;
    const R drag = min(alpha * abs(force), limit);
    return force - select(velocity > zero, drag, select(velocity < zero, -drag, zero));
}

/// Force on a block's centroid after local damping.
template <typename R>
struct DampedForce
{
    R x, y;
};

/// Local damping of translation. A block that can move along one axis only is damped along it.
template <typename R>
[[nodiscard]] inline DampedForce<R> damp_translation(const BasicActing<R>& acting, const BasicInertia<R>& inertia, R vx, R vy,
                                                     const BasicBlockDamping<R>& damping)
{
    if (!damping.along_joint)
        return {locally_damped(acting.x, vx, damping.local), locally_damped(acting.y, vy, damping.local)};
    const R zero = 0.0;
    const R along = acting.t_x * acting.x + acting.t_y * acting.y;
    const R across = acting.t_x * acting.y - acting.t_y * acting.x;
    const R drag_t = locally_damped(along, acting.t_x * vx + acting.t_y * vy, damping.local, acting.reserve) - along;
    const R drag_m = locally_damped(across, acting.t_x * vy - acting.t_y * vx, damping.local) - across;
    const auto on_axis = (inertia.inverse_mass_x == zero) | (inertia.inverse_mass_y == zero);
    return {select(on_axis, locally_damped(acting.x, vx, damping.local, acting.reserve),
                   acting.x + acting.t_x * drag_t - acting.t_y * drag_m),
            select(on_axis, locally_damped(acting.y, vy, damping.local, acting.reserve),
                   acting.y + acting.t_y * drag_t + acting.t_x * drag_m)};
}
}  // namespace hdem
