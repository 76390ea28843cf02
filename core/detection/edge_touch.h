#pragma once
/// Where two facing edges touch, exactly, at the blocks' present poses.

#include "core/state/blocks.h"
#include "core/state/contacts.h"

#include <cmath>

namespace hdem
{
/// One end of the stretch along which the incident edge lies over the reference edge, in the reference edge's axes.
template <typename R>
struct BasicTouchPoint
{
    R overlap = 0.0;  ///< > 0 when the blocks interpenetrate [m]
    R ref_t = 0.0;    ///< from the centroid of ref to the point [m]
    R ref_m = 0.0;
    R inc_t = 0.0;  ///< from the centroid of inc to the point [m]
    R inc_m = 0.0;
    R v_t = 0.0;  ///< velocity of inc relative to ref at the point, Eq. (3) [m/s]; along the edge
    R v_m = 0.0;  ///< into ref: > 0 when approaching
    R inside =
        0.0;  ///< how far the incident vertex lies within the reference edge's end [m]; < 0: the point is that end, else the vertex
};
using TouchPoint = BasicTouchPoint<double>;

/// Both ends, the axes and the length between them.
template <typename R>
struct BasicEdgeTouch
{
    R ex = 1.0;  ///< reference edge's direction t in the world [-]; m is it turned left
    R ey = 0.0;
    R length = 0.0;  ///< contact length: of the incident edge's part over the reference edge; <= 0: beside each other [m]
    R slope = 0.0;   ///< of the incident edge, d overlap / d t [-]
    BasicTouchPoint<R> point[2];  ///< 0 at the lower t
};
using EdgeTouch = BasicEdgeTouch<double>;

/// Whether the edges meet at an angle: a corner on a side, or pressed into it.
[[nodiscard]] inline bool is_corner_on_side(const EdgeTouch& touch)
{
    return std::abs(touch.slope) > 0.05;
}

/// Incident edge's two vertices in the axes and from the start of the reference edge.
template <typename R>
struct BasicEdgeView
{
    R ex, ey, d_t, d_m, t0, m0, t1, m1;
};
using EdgeView = BasicEdgeView<double>;

template <typename R>
[[nodiscard]] inline BasicEdgeView<R> view_edges(const BasicEdgePair<R>& e, const BasicMotion<R>& ref, const BasicMotion<R>& inc)
{
    BasicEdgeView<R> v;
    v.ex = ref.c * e.tx - ref.s * e.ty;
    v.ey = ref.s * e.tx + ref.c * e.ty;
    const R dx = inc.x - ref.x;
    const R dy = inc.y - ref.y;
    v.d_t = v.ex * dx + v.ey * dy;
    v.d_m = v.ex * dy - v.ey * dx;
    const R rc = v.ex * inc.c + v.ey * inc.s;  // rotation of inc as seen from the edge
    const R rs = v.ex * inc.s - v.ey * inc.c;
    const R o_t = v.d_t - e.start_t;
    const R o_m = v.d_m - e.start_m;
    v.t0 = o_t + (rc * e.p0x - rs * e.p0y);
    v.m0 = o_m + (rs * e.p0x + rc * e.p0y);
    v.t1 = o_t + (rc * e.p1x - rs * e.p1y);
    v.m1 = o_m + (rs * e.p1x + rc * e.p1y);
    return v;
}

/// Clip the incident edge to the extent of the reference edge; contact points are the two ends of what remains, each
/// halfway between the two surfaces. No branch, so that a loop over contacts can be vectorised.
///
/// @see verification/unit/core/detection/edge_touch_test.cpp
template <typename R>
[[nodiscard]] inline BasicEdgeTouch<R> touch_edges(const BasicEdgePair<R>& e, const BasicEdgeView<R>& v, const BasicMotion<R>& ref,
                                                   const BasicMotion<R>& inc)
{
    BasicEdgeTouch<R> touch;
    touch.ex = v.ex;
    touch.ey = v.ey;
    const R inc_low = min(v.t0, v.t1);
    const R inc_high = max(v.t0, v.t1);
    const R low = max(R(0.0), inc_low);
    const R high = min(e.length, inc_high);
    touch.length = high - low;
    const R run = v.t1 - v.t0;
    touch.slope = (v.m1 - v.m0) / select(run == R(0.0), R(1.0), run);
    const R u_t = v.ex * (inc.vx - ref.vx) + v.ey * (inc.vy - ref.vy);
    const R u_m = v.ex * (inc.vy - ref.vy) - v.ey * (inc.vx - ref.vx);
    for (int k = 0; k < 2; ++k)
    {
        const R t = k == 0 ? low : high;
        BasicTouchPoint<R>& p = touch.point[k];
        p.overlap = v.m0 + touch.slope * (t - v.t0);
        p.inside = k == 0 ? inc_low : e.length - inc_high;
        p.ref_t = e.start_t + t;
        p.ref_m = e.start_m + R(0.5) * p.overlap;
        p.inc_t = p.ref_t - v.d_t;
        p.inc_m = p.ref_m - v.d_m;
        p.v_t = u_t - inc.w * p.inc_m + ref.w * p.ref_m;
        p.v_m = u_m + inc.w * p.inc_t - ref.w * p.ref_t;
    }
    return touch;
}

template <typename R>
[[nodiscard]] inline BasicEdgeTouch<R> touch_edges(const BasicEdgePair<R>& e, const BasicMotion<R>& ref, const BasicMotion<R>& inc)
{
    return touch_edges(e, view_edges(e, ref, inc), ref, inc);
}

/// Velocity of inc relative to ref along t on the surface of inc, half of the overlap beyond the point [m/s].
template <typename R>
[[nodiscard]] inline R surface_velocity(const BasicTouchPoint<R>& p, R w_ref, R w_inc)
{
    return p.v_t - R(0.5) * (w_inc - w_ref) * p.overlap;
}

/// Rates of the velocities at a contact point while both blocks keep theirs: what turning alone does to them [m/s2].
///
///   surface_velocity:  w_ref^2 r_ref,t - w_inc^2 r_inc,t + 2 w_ref v_m + w c
///   v_t:               the same + w (v_m - c) / 2, since the point stays halfway between the surfaces
///   v_m:               w_ref^2 r_ref,m - w_inc^2 r_inc,m - (w_ref + w_inc) v_t   for an end of the reference edge
///                      w_ref^2 r_ref,m - w_inc^2 r_inc,m - 2 w_ref v_t - w^2 u / 2   for a vertex of the incident one
///
///   w = w_inc - w_ref   c = slope times the surface velocity, the overlap's rate by sliding at an end of the reference edge, 0 at a vertex   u overlap
/// @see verification/unit/core/detection/edge_touch_test.cpp
template <typename R>
struct TurningRate
{
    R t, surface, m;

    TurningRate(const BasicTouchPoint<R>& p, R slope, R w_ref, R w_inc)
    {
        const R zero = 0.0;
        const auto on_ref = p.inside < zero;
        const R w = w_inc - w_ref;
        const R c = select(on_ref, surface_velocity(p, w_ref, w_inc) * slope, zero);
        surface = w_ref * w_ref * p.ref_t - w_inc * w_inc * p.inc_t + R(2.0) * w_ref * p.v_m + w * c;
        t = surface + R(0.5) * w * (p.v_m - c);
        m = w_ref * w_ref * p.ref_m - w_inc * w_inc * p.inc_m - R(2.0) * w_ref * p.v_t -
            w * select(on_ref, p.v_t, R(0.5) * w * p.overlap);
    }
};

/// A contact point is closed down to this gap: far below any real overlap (a 1 m block rests on 4e-6 m), yet enough for
/// faces that were drawn as touching to count as touching, whatever their rounding. As a share of Contacts::length_floor,
/// that is 1e-9 of the smaller block's size at the default floor. The contact length must exceed it, too: else rounding would choose which of the corners
/// that meet in a point bear, each with the stiffness of the length floor.
inline constexpr double closed_gap = 1.0e-6;

template <typename R>
[[nodiscard]] inline auto is_closed(R contact_length, R overlap, R length_floor)
{
    const R gap = R(closed_gap) * length_floor;
    return (contact_length > gap) & (overlap > -gap);
}

/// Derivative of the bearing length by the contact length, see point_length [-].
template <typename R>
[[nodiscard]] inline R length_growth(R contact_length, R length_floor)
{
    return max(min(R(0.5) * contact_length / length_floor, R(1.0)), R(0.0));
}

/// One point's share of the contact length [m]: half of it from two floors on, at least half of the floor (a corner on a corner has next to none). Between them the
/// length grows as a parabola:
///
///   L = f + l^2 / (4 f)     for 0 <= l <= 2 f      dL/dl = l / (2 f)
///
/// With a bend at l = f the force along the edge (contact/force_law.h, dV/dL) would jump there, and a corner that rests at that place would rattle for ever.
template <typename R>
[[nodiscard]] inline R point_length(R contact_length, R length_floor)
{
    const R growth = length_growth(contact_length, length_floor);
    return R(0.5) * (max(contact_length, R(2.0) * length_floor) + length_floor * (growth * growth - R(1.0)));
}
}  // namespace hdem
