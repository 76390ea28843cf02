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

/// Who chooses the damping of a block.
struct DampingRule
{
    DampingPreset preset = DampingPreset::automatic;
    bool relaxing = false;  ///< the stage looks for a state of rest (motion/pace.h); only under `automatic`
};

/// Does damping ask for the most mobilised joint of a block?
[[nodiscard]] inline bool needs_joint(const DampingRule& rule)
{
    return rule.preset == DampingPreset::automatic && !rule.relaxing;
}

/// How local damping opposes a motion.
enum class LocalDamping
{
    last_velocity,  ///< the one half a step before the force: locally_damped
    along_joint,    ///< the same; translation along and across the block's most mobilised joint, along it by `reserve` at most
    new_velocity    ///< the one half a step after the force: stopped_by_damping
};

/// Damping of one block in one cycle.
template <typename R>
struct BasicBlockDamping
{
    R local = 0.0;           ///< alpha of Eqs. (13), (14) for translation [-]
    R local_rotation = 0.0;  ///< the same for rotation [-]
    R global = 0.0;          ///< alpha_d of Eqs. (20), (21) [1/s]
    LocalDamping form = LocalDamping::last_velocity;
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
/// A stage that runs until it has converged (is_relaxing) has all of local damping under `automatic` too: what is asked for then is a state of rest
/// close to where the rock began, and a block that swings past it has slipped there. Next to the tunnel blocks move 0.4 mm farther otherwise. It opposes the
/// new velocity, which is stable at larger steps.
template <typename R>
[[nodiscard]] inline BasicBlockDamping<R> conditional_damping(const BasicActing<R>& acting, const DampingRule& rule,
                                                              const DampingDef& damping)
{
    const bool by_joint = needs_joint(rule);
    const double alpha = rule.preset == DampingPreset::dynamic ? 0.0 : damping.local;
    const R none = 0.0;
    const R local = select(acting.impulses, none, select(acting.springs, R(alpha), none));
    return {.local = local,
            .local_rotation = by_joint ? local * (R(1.0) - acting.mobilised) : local,
            .global = select(acting.impulses, R(2.0 * damping.global_damping_ratio * damping.average_frequency), none),
            .form = rule.relaxing ? LocalDamping::new_velocity
                    : by_joint    ? LocalDamping::along_joint
                                  : LocalDamping::last_velocity};
}

/// Force left of `force` once local damping has opposed the motion:
///
///   F - alpha |F| sgn(v)                                             [Lee2025] Eqs. (11)-(14)
///
/// per component, with F the *net* force on the block, gravity and loads included. (With the sum of the contacts' absolute
/// forces, the other reading of Eq. (13), the exact static force is never reached.)
///
/// v is half a step old. Where a spring brakes a block it does so with 1 + alpha times its force, so that steps above
///
///   2 / (omega_max sqrt(1 + alpha)),  0.745 of the stable limit at alpha = 0.8
///
/// feed the swinging of a block on a spring by itself; a wall of 48 blocks still came to rest at 0.97, but a tunnel squeezed by 0.1 mm more at 0.8.
/// @param limit  greatest damping force [N]
template <typename R>
[[nodiscard]] inline R locally_damped(R force, R velocity, R alpha, R limit = std::numeric_limits<double>::infinity())
{
    const R zero = 0.0;
    const R drag = min(alpha * abs(force), limit);
    return force - select(velocity > zero, drag, select(velocity < zero, -drag, zero));
}

/// The same with sgn of the velocity at the end of the step, and no more than stops the block there:
///
///   F_d = m v / dt + F,  |F_d| <= alpha |F|
///
/// Never turns a motion round, and is stable wherever the springs are without damping. For slow motions it differs from the form above in one cycle of each
/// turning point.
template <typename R>
[[nodiscard]] inline R stopped_by_damping(R force, R velocity, R inverse_mass, R dt, R alpha)
{
    const R zero = 0.0;
    const auto is_free = inverse_mass > zero;
    const R stop = velocity / (select(is_free, inverse_mass, R(1.0)) * dt) + force;
    const R most = alpha * abs(force);
    return select(is_free, force - max(min(stop, most), -most), force);
}

/// Force on a block's centroid after local damping.
template <typename R>
struct DampedForce
{
    R x, y;
};

/// Local damping of translation. A block that can move along one axis only is damped along it.
template <typename R>
[[nodiscard]] inline DampedForce<R> damp_translation(const BasicActing<R>& acting, const BasicInertia<R>& inertia, R vx, R vy, R dt,
                                                     const BasicBlockDamping<R>& damping)
{
    if (damping.form == LocalDamping::new_velocity)
        return {stopped_by_damping(acting.x, vx, inertia.inverse_mass_x, dt, damping.local),
                stopped_by_damping(acting.y, vy, inertia.inverse_mass_y, dt, damping.local)};
    if (damping.form == LocalDamping::last_velocity)
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

/// Moment on a block after local damping.
template <typename R>
[[nodiscard]] inline R damp_rotation(const BasicActing<R>& acting, const BasicInertia<R>& inertia, R w, R dt,
                                     const BasicBlockDamping<R>& damping)
{
    return damping.form == LocalDamping::new_velocity
               ? stopped_by_damping(acting.moment, w, inertia.inverse_inertia, dt, damping.local_rotation)
               : locally_damped(acting.moment, w, damping.local_rotation);
}
}  // namespace hdem
