#pragma once
/// Where two facing edges touch, exactly, at the blocks' present poses.

#include "core/state/blocks.h"
#include "core/state/contacts.h"

#include <algorithm>

namespace hdem
{
/// One end of the stretch along which the incident edge lies over the reference edge, in the reference edge's axes.
struct TouchPoint
{
    double overlap = 0.0;  ///< > 0 when the blocks interpenetrate [m]
    double ref_t = 0.0;    ///< from the centroid of ref to the point [m]
    double ref_m = 0.0;
    double inc_t = 0.0;  ///< from the centroid of inc to the point [m]
    double inc_m = 0.0;
    double v_t = 0.0;     ///< velocity of inc relative to ref at the point, Eq. (3) [m/s]; along the edge
    double v_m = 0.0;     ///< into ref: > 0 when approaching
    bool on_ref = false;  ///< an end of the reference edge; else a vertex of the incident one
};

/// Both ends, the axes and the length between them.
struct EdgeTouch
{
    double ex = 1.0;  ///< reference edge's direction t in the world [-]; m is it turned left
    double ey = 0.0;
    double length = 0.0;  ///< contact length: of the incident edge's part over the reference edge; <= 0: beside each other [m]
    TouchPoint point[2];  ///< 0 at the lower t
};

/// Incident edge's two vertices in the axes and from the start of the reference edge.
struct EdgeView
{
    double ex, ey, d_t, d_m, t0, m0, t1, m1;
};

[[nodiscard]] inline EdgeView view_edges(const EdgePair& e, const BlockMotion& ref, const BlockMotion& inc)
{
    EdgeView v;
    v.ex = ref.c * e.tx - ref.s * e.ty;
    v.ey = ref.s * e.tx + ref.c * e.ty;
    const double dx = inc.x - ref.x;
    const double dy = inc.y - ref.y;
    v.d_t = v.ex * dx + v.ey * dy;
    v.d_m = v.ex * dy - v.ey * dx;
    const double rc = v.ex * inc.c + v.ey * inc.s;  // rotation of inc as seen from the edge
    const double rs = v.ex * inc.s - v.ey * inc.c;
    const double o_t = v.d_t - e.start_t;
    const double o_m = v.d_m - e.start_m;
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
[[nodiscard]] inline EdgeTouch touch_edges(const EdgePair& e, const EdgeView& v, const BlockMotion& ref, const BlockMotion& inc)
{
    EdgeTouch touch;
    touch.ex = v.ex;
    touch.ey = v.ey;
    const double inc_low = std::min(v.t0, v.t1);
    const double inc_high = std::max(v.t0, v.t1);
    const double low = std::max(0.0, inc_low);
    const double high = std::min(e.length, inc_high);
    touch.length = high - low;
    const double run = v.t1 - v.t0;
    const double slope = (v.m1 - v.m0) / (run == 0.0 ? 1.0 : run);
    const double u_t = v.ex * (inc.vx - ref.vx) + v.ey * (inc.vy - ref.vy);
    const double u_m = v.ex * (inc.vy - ref.vy) - v.ey * (inc.vx - ref.vx);
    for (int k = 0; k < 2; ++k)
    {
        const double t = k == 0 ? low : high;
        TouchPoint& p = touch.point[k];
        p.overlap = v.m0 + slope * (t - v.t0);
        p.on_ref = k == 0 ? inc_low < 0.0 : inc_high > e.length;
        p.ref_t = e.start_t + t;
        p.ref_m = e.start_m + 0.5 * p.overlap;
        p.inc_t = p.ref_t - v.d_t;
        p.inc_m = p.ref_m - v.d_m;
        p.v_t = u_t - inc.w * p.inc_m + ref.w * p.ref_m;
        p.v_m = u_m + inc.w * p.inc_t - ref.w * p.ref_t;
    }
    return touch;
}

/// Rates of v_t and v_m at a contact point while both blocks keep their velocities: what turning alone does to them [m/s2].
///
///   a_t = w_ref^2 r_ref,t - w_inc^2 r_inc,t + w v_m
///   a_m = w_ref^2 r_ref,m - w_inc^2 r_inc,m - w v_t
///
/// with w = w_ref + w_inc for a point that stays on ref, 2 w_ref for one that stays on inc.
struct TurningRate
{
    double t, m;

    TurningRate(const TouchPoint& p, double w_ref, double w_inc)
    {
        const double w = w_ref + (p.on_ref ? w_inc : w_ref);
        t = w_ref * w_ref * p.ref_t - w_inc * w_inc * p.inc_t + w * p.v_m;
        m = w_ref * w_ref * p.ref_m - w_inc * w_inc * p.inc_m - w * p.v_t;
    }
};

/// A contact point is closed down to this gap: far below any real overlap (a 1 m block rests on 4e-6 m), yet enough for
/// faces that were drawn as touching to count as touching, whatever their rounding. As a share of Contacts::length_floor,
/// that is 1e-9 of the smaller block's size at the default floor.
inline constexpr double closed_gap = 1.0e-6;

[[nodiscard]] inline bool is_closed(double contact_length, double overlap, double length_floor)
{
    return (contact_length > 0.0) & (overlap > -closed_gap * length_floor);
}

/// One point's share of the contact length: half, but at least half of the floor (a corner on a corner has next to none) [m].
[[nodiscard]] inline double point_length(double contact_length, double length_floor)
{
    return 0.5 * std::max(contact_length, length_floor);
}
}  // namespace hdem
