#pragma once
/// Normal springs in the cycles in which they close or open.

#include "core/contact/contact_lanes.h"
#include "core/contact/force_law.h"

namespace hdem
{
/// How a point's overlap, beyond the rest overlap, changes about this cycle [m].
template <typename R>
struct BasicOverlapCourse
{
    R now = 0.0;     ///< u(t) >= 0
    R past = 0.0;    ///< u(t) - u(t - dt), dt the last step
    R coast = 0.0;   ///< what the velocities of now add to u(t + dt), dt the next step
    R others = 0.0;  ///< what other forces on the two blocks add to u(t + dt), taken from the last cycle
    R answer = 0.0;  ///< what the contact's own forces take off it, if they act in whole; < 0: the other point presses this one
};
using OverlapCourse = BasicOverlapCourse<double>;

/// Share of its force that a normal spring gives in this cycle. It is 1, except where the spring has closed since the last cycle or will be open by the next.
///
///   F = s K_N L u,  s = (u'+ - u"+) / (u' - u"),  u' = u + coast + others - s answer
///
///   u", u, u'  overlaps at t - dt, t, t + dt      u+ = max(u, 0)
///
/// Why: a spring that closes amid a cycle acts up to a cycle late, and lets go up to a cycle late. With whole forces blocks lose K_N L |u"| u / 2 as it closes and
/// gain as much as it opens, up to (omega dt)^2 / 4 of the energy. A force works over (u' - u") / 2 in a step (energy_ledger.h), so with this share the energy of
/// the springs goes from K_N L u"+ u+ / 2 to K_N L u+ u'+ / 2, and nothing is lost or made. Figures: core/tried.md.
///
/// Exact for one point, and for the two points of a face. Other forces are estimated from the last cycle, biased so that the scheme dissipates: as a spring
/// closes, what presses counts; as it opens, twice what pulls. Where the answer is more than the overlap what presses counts too; nothing could rest there
/// otherwise. As a spring opens, a negative answer, by which the other point presses this one, belongs to the other forces: where these balance it, the point rests.
///
/// Not in the paper: see Closing in regime.h.
/// @see verification/unit/core/contact/closing_test.cpp
template <typename R>
[[nodiscard]] inline R closing_share(const BasicOverlapCourse<R>& u)
{
    using std::sqrt;
    const R zero = 0.0;
    const R tiny = std::numeric_limits<double>::min();
    const R gap = u.past - u.now;  // at t - dt; < 0 if the spring was closed
    const auto square = [](R x) { return x * x; };
    const R answer = max(u.answer, zero);
    // Closing: u'^2 + (gap + answer - free) u' = free gap.
    const R free = max(u.now + u.coast + max(u.others, zero), zero);
    const R half = R(0.5) * (free - gap - answer);
    const R next = half + sqrt(square(half) + free * max(gap, zero));
    // Opening: the same with u' = -beyond and an overlap `last` before.
    const R last = max(-gap, zero);
    const R others = u.others - min(u.answer, zero);
    const R end = u.now + u.coast + select(answer > u.now, max(others, zero), zero) + R(2.0) * min(others, zero);
    const R mean = R(0.5) * (end + last);
    const R beyond = sqrt(max(square(mean) + (answer - end) * last, zero)) - mean;
    return select(gap > zero, next / max(next + gap, tiny), select(end < answer, last / max(last + beyond, tiny), R(1.0)));
}

/// Contacts with a point at which one block moves past the other faster than `speed`.
template <typename P>
[[nodiscard, gnu::always_inline]] inline MaskOf<P> are_faster(const BasicEdgeTouch<P>& touch, double speed)
{
    const auto square = [](const BasicTouchPoint<P>& point) { return point.v_m * point.v_m + point.v_t * point.v_t; };
    return max(square(touch.point[0]), square(touch.point[1])) > P(speed * speed);
}

/// What closing needs of a touch, with overlaps as the springs see them, preload included [m, m/s]. (A struct of its own: a whole touch, passed on, would
/// stay in memory and not in registers.)
template <typename P>
struct ClosingTouch
{
    P ex, ey;
    P pressed[2], v_m[2], ref_t[2], inc_t[2];
};

/// Square of twice the longer step, for may_close_or_open [s2].
[[nodiscard]] inline double closing_ways(const Steps& step)
{
    const double dt = std::max(step.last, step.next);
    return 4.0 * dt * dt;
}

/// Contacts that may close or open within a cycle: in two cycles, one of their points moves by more than its overlap or gap.
template <typename P>
[[nodiscard, gnu::always_inline]] inline MaskOf<P> may_close_or_open(const ClosingTouch<P>& touch, P ways)
{
    const auto slowness = [&](int k) { return touch.pressed[k] * touch.pressed[k] - ways * touch.v_m[k] * touch.v_m[k]; };
    return min(slowness(0), slowness(1)) < P(0.0);
}

/// closing_share of both points of four contacts. `stiffness`: K_N L of each point [N/m], `recovery`: way of rest_overlap [m].
template <typename P>
[[nodiscard, gnu::noinline]] inline std::array<P, 2> closing_shares(const Blocks& blocks, const ContactLanes& l,
                                                                    const Index* at_ref, const Index* at_inc,
                                                                    const ClosingTouch<P>& touch, P stiffness, P recovery)
{
    const BasicInertia<P> ref = load_inertias<P>(blocks.inertia, at_ref);
    const BasicInertia<P> inc = load_inertias<P>(blocks.inertia, at_inc);
    const P across = (ref.inverse_mass_x + inc.inverse_mass_x) * touch.ey * touch.ey +
                     (ref.inverse_mass_y + inc.inverse_mass_y) * touch.ex * touch.ex;
    const auto response = [&](int j, int k)  // of the approach at j to a unit force at k [1/kg]
    {
        return across + ref.inverse_inertia * touch.ref_t[j] * touch.ref_t[k] +
               inc.inverse_inertia * touch.inc_t[j] * touch.inc_t[k];
    };
    const P coupling = response(0, 1);
    const BasicForceLanes<P> on_ref = load_forces<P>(blocks.force, at_ref), on_inc = load_forces<P>(blocks.force, at_inc);
    const P a_x = on_inc.x * inc.inverse_mass_x - on_ref.x * ref.inverse_mass_x;
    const P a_y = on_inc.y * inc.inverse_mass_y - on_ref.y * ref.inverse_mass_y;
    const P turn_ref = on_ref.moment * ref.inverse_inertia, turn_inc = on_inc.moment * inc.inverse_inertia;
    P u[2], last_normal[2];
    for (int k = 0; k < 2; ++k)
    {
        u[k] = max(touch.pressed[k] - rest_overlap(touch.pressed[k], load_lane<P>(l, l.rest_overlap[k]), recovery), P(0.0));
        last_normal[k] = load_lane<P>(l, l.normal_force[k]);
    }
    const P acting = blocks.step.kick() * blocks.step.next;  // of an acceleration, on the overlap at t + dt
    std::array<P, 2> share;
    for (int k = 0; k < 2; ++k)
    {
        const P own = response(k, k);
        const P last = touch.ex * a_y - touch.ey * a_x + turn_inc * touch.inc_t[k] - turn_ref * touch.ref_t[k];
        const P others = last + own * last_normal[k] + coupling * last_normal[1 - k];
        const P answer = stiffness * (own * u[k] + coupling * u[1 - k]);
        const P past = touch.v_m[k] * blocks.step.last;
        const P of_point = closing_share<P>({.now = u[k],
                                             .past = past,
                                             .coast = touch.v_m[k] * blocks.step.next,
                                             .others = others * acting,
                                             .answer = answer * acting});
        // In the first cycle of a run, the forces of a last cycle are not known yet.
        share[k] = select((last_normal[k] > P(0.0)) | (past > u[k]), of_point, 1.0);
    }
    return share;
}
}  // namespace hdem
