#pragma once
/// Four contacts in one cycle: what is known of them before their laws, and which law each obeys.

#include "core/contact/contact_lanes.h"
#include "core/contact/kept_springs.h"
#include "core/contact/regime.h"
#include "core/detection/edge_touch.h"
#include "core/model/model.h"

namespace hdem
{
/// What the threshold velocity needs of a cycle.
struct Threshold
{
    double scale;
    double gravity_velocity;    ///< what gravity gives in a cycle, dt |g| [m/s]
    double load_time;           ///< without gravity dt, for load_velocity; else 0 [s]
    double fixed;               ///< given velocity, or negative [m/s]
    bool rock_keeps_springs;    ///< RegimeRule
    bool corners_keep_springs;  ///< RegimeRule
    [[nodiscard]] double least() const { return fixed >= 0.0 ? fixed : scale * gravity_velocity; }
};

/// Contacts of a pack and what is known of them in this cycle.
template <typename P>
struct BasicContactGroup
{
    using M = MaskOf<P>;

    BasicContactGroup(const BasicEdgeTouch<P>& edge_touch, P w_ref, P w_inc)
        : touch(edge_touch),
          turning{{edge_touch.point[0], edge_touch.slope, w_ref, w_inc}, {edge_touch.point[1], edge_touch.slope, w_ref, w_inc}},
          w(w_inc - w_ref)
    {
    }

    const BasicEdgeTouch<P>& touch;
    TurningRate<P> turning[2];
    P w;  ///< of inc relative to ref
    // Set later: filling these with zeros here, or copying the touch, would cost a tenth of the law's time.
    const Index* ref;
    const Index* inc;
    const BasicJointLanes<P>* joint;
    P length;  ///< each point's share of the contact length
    P growth;  ///< length_growth of it [-]
    P last_length, length_inverse;
    P recovery;     ///< by which a rest overlap shrinks in a cycle [m]
    P shear_share;  ///< of the shear forces that stays as the contact length changes (force_law.h)
    M closed[2];
    M was_impulse[2];
    P last_normal[2], last_shear[2];
    P preload[2];  ///< only where contacts have one [m]
};
using ContactGroup = BasicContactGroup<Pack>;

/// What one contact point adds to the threshold velocity where there is no gravity; their sum stands for dt |g| in Eq. (25) [m/s]:
///
///   dt |F_N| / m_cN
///
///   F_N  force of the last cycle, of springs or impulses [N]
///
/// Differs from the paper: there the threshold is 0 without gravity, as impulses store nothing. But loads and walls press joints then, too. A joint that
/// had once taken an impulse would obey impulses for ever: without its stiffness, without its roughness,
/// and with an arbitrary force where a wall moves. A point that touches for the first time has no force yet, so it still counts as an impact.
template <typename R>
[[nodiscard]] inline R load_velocity(R last_normal, R inverse_mass_normal, R dt)
{
    return dt * abs(last_normal) * inverse_mass_normal;
}

/// Masses of blocks in the threshold velocity. With contact.fixed_mass_counts a fixed block counts with its mass, as the ground does in the paper
/// (m_c = m/2 for equal blocks without levers). Its moment of inertia never counts.
template <typename P>
inline BasicInertia<P> threshold_inertias(const Model& model, const Blocks& blocks, const Index* at)
{
    BasicInertia<P> inertia = load_inertias<P>(blocks.inertia, at);
    if (model.contact.fixed_mass_counts)
    {
        const BasicInertia<P> full = load_inertias<P>(model.full_inertia, at);
        inertia.inverse_mass_x = full.inverse_mass_x;
        inertia.inverse_mass_y = full.inverse_mass_y;
    }
    return inertia;
}

/// Regime under the hybrid method, Eq. (24): impulse as soon as one of a contact's closed points is faster than the threshold.
/// Inline, as the next two: calls would cost instructions (core/tried.md).
template <typename P>
[[gnu::always_inline]] inline MaskOf<P> are_fast(const BasicContactGroup<P>& g, P speed_squared, const Model& model,
                                                 const Blocks& blocks, const Threshold& threshold)
{
    // A block that gravity has pulled for one cycle has just dt |g|: rounding must not decide that tie.
    const P margin = 1.0 + 1e-9;
    if (threshold.fixed >= 0.0)
        return speed_squared > P(threshold.fixed * threshold.fixed) * margin;
    const BasicInertia<P> ref = threshold_inertias<P>(model, blocks, g.ref);
    const BasicInertia<P> inc = threshold_inertias<P>(model, blocks, g.inc);
    P elastic = 0.0, weight = threshold.gravity_velocity;
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<P>& p = g.touch.point[k];
        const P mass_n = inverse_collision_mass(ref, p.ref_t, inc, p.inc_t, -g.touch.ey, g.touch.ex);
        const P mass_s = inverse_collision_mass(ref, p.ref_m, inc, p.inc_m, g.touch.ex, g.touch.ey);
        // Springs that an impulse has emptied have stored nothing.
        const P normal = select(g.was_impulse[k], 0.0, g.last_normal[k]);
        const P shear = select(g.was_impulse[k], 0.0, g.last_shear[k]);
        elastic += elastic_velocity_squared(normal, g.joint->law.normal_stiffness * g.length, mass_n, shear,
                                            g.joint->law.shear_stiffness * g.length, mass_s);
        if (threshold.load_time > 0.0)
            weight += load_velocity(g.last_normal[k], mass_n, P(threshold.load_time));
    }
    const P u_th = threshold_velocity(P(threshold.scale), weight, elastic);
    return speed_squared > u_th * u_th * margin;
}

/// Square of the speed that counts in Eq. (24): of the faster closed point [m2/s2].
template <typename P>
[[nodiscard, gnu::always_inline]] inline P motion_squared(const BasicContactGroup<P>& g)
{
    P speed = 0.0;
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<P>& p = g.touch.point[k];
        speed = max(speed, select(g.closed[k], p.v_t * p.v_t + p.v_m * p.v_m, 0.0));
    }
    return speed;
}

/// The same for the approach velocity alone.
template <typename P>
[[nodiscard, gnu::always_inline]] inline P approach_squared(const BasicContactGroup<P>& g)
{
    P approach = 0.0;
    for (int k = 0; k < 2; ++k)
        approach = max(approach, select(g.closed[k], g.touch.point[k].v_m, 0.0));
    return approach * approach;
}

template <ContactLaw law, typename P>
[[nodiscard, gnu::always_inline]] inline MaskOf<P> are_impulsive(const BasicContactGroup<P>& g, P speed, const Model& model,
                                                                 const Blocks& blocks, const Threshold& threshold)
{
    const MaskOf<P> none{};
    if constexpr (law != ContactLaw::by_speed)
        return law == ContactLaw::impulses ? !none : none;
    // The elastic part only raises the threshold. Slower contacts need no more work.
    const double least = threshold.least();
    if (!any(speed > P(least * least)))
        return none;
    MaskOf<P> fast = are_fast(g, speed, model, blocks, threshold);
    if (threshold.corners_keep_springs || threshold.rock_keeps_springs)
    {
        const MaskOf<P> is_short = g.growth < P(1.0);
        for (int j = 0; j < P::width; ++j)
            if (fast.has(j))
            {
                const PressedPair pair{.ref = g.ref[j],
                                       .inc = g.inc[j],
                                       .stiffness = 2.0 * g.joint->law.normal_stiffness.v[j] * g.length.v[j],
                                       .speed_squared = speed.v[j]};
                if ((threshold.corners_keep_springs && is_short.has(j) && do_corners_keep_springs(pair, model, blocks)) ||
                    (threshold.rock_keeps_springs && does_rock_keep_springs(pair, model, blocks)))
                    fast.clear(j);
            }
    }
    return fast;
}
}  // namespace hdem
