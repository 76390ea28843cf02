#pragma once
/// Which damping acts on a block, by the contacts it has in this cycle.

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
    R mobilised = -1.0;  ///< share of the shear strength in use at the joint where it is greatest; -1: no joint bears the block [-]
    R t_x = 1.0, t_y = 0.0;          ///< direction of that joint [-]
    decltype(R() < R()) springs{};   ///< has contact points in the force regime
    decltype(R() < R()) impulses{};  ///< has contact points in the impulse regime
};
using Acting = BasicActing<double>;

/// How local damping opposes a motion.
enum class LocalDamping
{
    by_axis,     ///< as published: the components along x and y, against the velocity half a step before the force (locally_damped)
    along_joint  ///< the components along and across the block's most mobilised joint, against the new velocity (stopped_by_damping)
};

/// For a limit that no motion reaches [m/s]
inline constexpr double above_all_speeds = std::numeric_limits<double>::infinity();

/// How all held blocks move, where they move as one rigid body.
struct SupportMotion
{
    double x = 0.0, y = 0.0;             ///< a point of it [m]
    double vx = 0.0, vy = 0.0, w = 0.0;  ///< velocity there [m/s], of rotation [rad/s]

    [[nodiscard]] bool is_none() const { return vx == 0.0 && vy == 0.0 && w == 0.0; }
};

/// Who chooses the damping of a block.
struct DampingRule
{
    double local = 0.0;   ///< alpha of Eqs. (13), (14) [-]
    double global = 0.0;  ///< alpha_d = 2 xi_g omega_avg of Eq. (22) [1/s]
    LocalDamping form = LocalDamping::by_axis;
    double settling =
        0.0;  ///< below this speed (along the joint, or of the rim) all of local damping acts, above twice this speed only what unused friction allows [m/s]
    double turning = above_all_speeds;  ///< from this speed on damping that turns a motion gives no energy (most_at_turn) [m/s]
    bool follows_support =
        false;                  ///< local damping opposes motions against `support`: a block that rides on a base is at rest there
    SupportMotion support;      ///< of this cycle
    bool frees_sliding = true;  ///< form along_joint: blocks that slide are damped less across the joint; else by alpha

    /// Does this rule need the most mobilised joint of each block?
    [[nodiscard]] bool needs_joint() const { return form == LocalDamping::along_joint; }
};

/// Damping of one block in one cycle.
template <typename R>
struct BasicBlockDamping
{
    R local = 0.0;           ///< alpha of Eqs. (13), (14) for translation [-]
    R local_across = 0.0;    ///< the same across the joint [-]
    R local_rotation = 0.0;  ///< the same for rotation [-]
    R braking = 0.0;         ///< share that is added to moments that brake a rotation [-]
    bool slides = false;     ///< one of the blocks slides; else local_across is local, and braking is 0
    R global = 0.0;          ///< alpha_d of Eqs. (20), (21) [1/s]
    LocalDamping form = LocalDamping::by_axis;
    double settling = 0.0;              ///< [m/s]
    double turning = above_all_speeds;  ///< [m/s]
};
using BlockDamping = BasicBlockDamping<double>;

/// Share of the shear strength in use above which a joint slides [-]
inline constexpr double sliding_from = 0.99;

/// Share of local damping that acts across a joint that slides [-]
inline constexpr double sliding_share = 0.6;

/// Conditional damping, [Lee2025] sect. 3.3 (whose equation numbers are swapped in print):
///
///   at least one impulse contact:  global damping, alpha_d = 2 xi_g omega_avg, Eqs. (20)-(22)
///   only force contacts:           local damping, alpha, Eqs. (11)-(14)
///   no contact:                    none
///
/// The form by axis does no more. In the form along the joint, hdem's own, local damping holds a block back by no more than its unused friction could. Along the most
/// mobilised joint, the damping force is at most the sum of what all force points of the block have in reserve,
///
///   |F_d,t| <= sum (F_max - |F_S|)
///
/// across it all of the net force counts, so that a block does not go on swinging on its normal springs, and rotation is damped by
/// alpha (1 - |F_S| / F_max) of that joint.
///
/// A block that slides has nothing in reserve and moves freely. It may also tip. But if it swings on its normal springs, damping by the sign of the velocity presses
/// it into the joint as soon as the swing is not symmetric (it hops on a corner, it tips): forces of the joint grow, and with them friction. So, for a
/// block that slides (`sliding_from`),
///
///   0.6 alpha             damps it across the joint
///   2 alpha / (1 - alpha) times a moment that brakes its rotation is added to it (braked_rotation): half a swing loses as much as by local damping,
///                         while moments that speed a rotation up are not damped
///
/// (core/tried.md: other shares.) A block about to slide moves as on a rigid-plastic joint from the start: net force less reserve is driving force less strength, D - S, whatever
/// its shear springs carry already (exact while reserve < alpha |F|, for S up to alpha D).
///
/// Motions slower than `settling` are damped by alpha all the same: a block on a joint at its strength would swing on its normal springs for thousands of cycles. Where
/// no joint bears the block yet (least_joint_load), nothing damps it. The axes are those of the joint: the answer does not depend on how the model is turned.
/// @see verification/unit/core/motion/damping_test.cpp
template <typename R>
[[nodiscard]] inline BasicBlockDamping<R> conditional_damping(const BasicActing<R>& acting, const DampingRule& rule)
{
    const R none = 0.0;
    const auto held = rule.needs_joint() ? acting.springs & !(acting.mobilised < none) : acting.springs;
    const R local = select(acting.impulses, none, select(held, R(rule.local), none));
    const auto slides = acting.mobilised > R(sliding_from);
    const bool some = rule.needs_joint() && rule.frees_sliding && any(slides);
    return {.local = local,
            .local_across = some ? select(slides, R(sliding_share) * local, local) : local,
            .local_rotation = rule.needs_joint() ? local * (R(1.0) - acting.mobilised) : local,
            .braking = some ? select(slides, local * R(2.0 / (1.0 - rule.local)), none) : none,
            .slides = some,
            .global = select(acting.impulses, R(rule.global), none),
            .form = rule.form,
            .settling = rule.settling,
            .turning = rule.turning};
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
/// feed energy into the swinging of a block on a spring (core/tried.md: longer steps in a wall and a tunnel).
/// @param limit  greatest damping force [N]
template <typename R>
[[nodiscard]] inline R locally_damped(R force, R velocity, R alpha, R limit = std::numeric_limits<double>::infinity())
{
    const R zero = 0.0;
    const R drag = min(alpha * abs(force), limit);
    return force - select(velocity > zero, drag, select(velocity < zero, -drag, zero));
}

/// Share of a motion that counts as slow: 1 up to the speed, 0 from twice of it on.
template <typename R>
[[nodiscard]] inline R slow_share(R speed, double slow)
{
    const R zero = 0.0;
    return slow > 0.0 ? max(min(R(2.0) - speed / R(slow), R(1.0)), zero) : zero;
}

/// Greatest damping force in the cycle in which a force F turns a motion round, from `before` p / dt to `after` q / dt = p / dt + F, with p and q momenta [N]. Damping opposes
/// q but works along p + q, so it gives energy where |q| < |p|. Fast motions lose only what keeps the energy of a block on a spring least, slow ones are stopped:
///
///   |F_d| <= max(|q| - 2 |p|, (|q| - |p|) / 2, 0) / dt   of fast motions, |q| / dt of slow ones
///
/// (core/tried.md: other forms. At all speeds, vibration would hold back what begins to tip.)
/// @param speed  of the motion [m/s]
/// @param slow   up to this speed it counts as slow, from twice of it on as fast [m/s]
template <typename R>
[[nodiscard]] inline R most_at_turn(R before, R after, R speed, double slow)
{
    const R zero = 0.0;
    const R p = abs(before), q = abs(after);
    const R fast = max(max(q - R(2.0) * p, R(0.5) * (q - p)), zero);
    return select((before * after < zero) & (speed > R(slow)), fast + slow_share(speed, slow) * (q - fast), q);
}

/// The same with sgn of the velocity at the end of the step, and no more than stops the block there:
///
///   F_d = m v / dt + F,  |F_d| <= alpha |F|
///
/// Never turns a motion round, and is stable wherever the springs are without damping. For slow motions it differs from the form above in one cycle of each
/// turning point.
/// @param limit  greatest damping force [N]
/// @param speed, slow  see most_at_turn; without them all motions count as slow
template <typename R>
[[nodiscard]] inline R stopped_by_damping(R force, R velocity, R inverse_mass, R dt, R alpha, R speed = 0.0,
                                          double slow = above_all_speeds, R limit = std::numeric_limits<double>::infinity())
{
    const R zero = 0.0;
    const auto is_free = inverse_mass > zero;
    const R before = velocity / (select(is_free, inverse_mass, R(1.0)) * dt);
    const R stop = before + force;
    R most = min(alpha * abs(force), limit);
    if (slow < above_all_speeds)
        most = min(most, most_at_turn(before, stop, speed, slow));
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
    if (damping.form == LocalDamping::by_axis)
        return {locally_damped(acting.x, vx, damping.local), locally_damped(acting.y, vy, damping.local)};
    const R zero = 0.0;
    const R t = acting.t_x * acting.x + acting.t_y * acting.y;
    const R m = acting.t_x * acting.y - acting.t_y * acting.x;
    // Nearly all rock is slow: then nothing is to be looked at below.
    const auto may_be_fast = (damping.local > zero) & (vx * vx + vy * vy > R(0.5 * damping.turning * damping.turning));
    const double turning = any(may_be_fast) ? damping.turning : above_all_speeds;
    const auto along = [&](R force, R velocity, R inverse_mass)
    {
        const R limit = acting.reserve + slow_share(abs(velocity), damping.settling) * damping.local * abs(force);
        return stopped_by_damping(force, velocity, inverse_mass, dt, damping.local, abs(velocity), turning, limit);
    };
    const R damped_t = along(t, acting.t_x * vx + acting.t_y * vy, inertia.inverse_mass_x);
    const R v_m = acting.t_x * vy - acting.t_y * vx;
    const R across = damping.slides ? max(damping.local_across, slow_share(abs(v_m), damping.settling) * damping.local)
                                    : damping.local;
    const R damped_m = stopped_by_damping(m, v_m, inertia.inverse_mass_x, dt, across, abs(v_m), turning);
    const DampedForce<R> damped = {acting.t_x * damped_t - acting.t_y * damped_m, acting.t_y * damped_t + acting.t_x * damped_m};
    const auto on_axis = (inertia.inverse_mass_x == zero) | (inertia.inverse_mass_y == zero);
    if (!any(on_axis))
        return damped;
    return {select(on_axis, along(acting.x, vx, inertia.inverse_mass_x), damped.x),
            select(on_axis, along(acting.y, vy, inertia.inverse_mass_y), damped.y)};
}

/// Moment that is added to one that brakes a rotation. It takes at most half of the rotation in a cycle: it can slow a block but not hold it,
/// so that no block rests out of balance.
template <typename R>
[[nodiscard]] inline R braked_rotation(R moment, R w, R inverse_inertia, R dt, R braking)
{
    const R zero = 0.0;
    const auto brakes = (moment * w < zero) & (inverse_inertia > zero);
    const R half = R(0.5) * abs(w) / (select(brakes, inverse_inertia, R(1.0)) * dt);
    const R more = min(braking * abs(moment), half);
    return select(brakes, select(w > zero, -more, more), zero);
}

/// Moment on a block after local damping.
template <typename R>
[[nodiscard]] inline R damp_rotation(const BasicActing<R>& acting, const BasicInertia<R>& inertia, R w, R radius, R dt,
                                     const BasicBlockDamping<R>& damping)
{
    if (damping.form == LocalDamping::by_axis)
        return locally_damped(acting.moment, w, damping.local_rotation);
    const R zero = 0.0, rim = abs(w) * radius;
    const R slow = slow_share(rim, damping.settling);
    const R damped = stopped_by_damping(
        acting.moment, w, inertia.inverse_inertia, dt, max(damping.local_rotation, slow * damping.local), rim,
        any((damping.local > zero) & (rim > R(damping.turning))) ? damping.turning : above_all_speeds);
    if (!damping.slides)
        return damped;
    return damped + braked_rotation(acting.moment, w, inertia.inverse_inertia, dt, (R(1.0) - slow) * damping.braking);
}
}  // namespace hdem
