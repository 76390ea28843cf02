#pragma once
/// Four contacts in one cycle: what is known of them before their laws, and which law each obeys.

#include "core/contact/contact_lanes.h"
#include "core/contact/regime.h"
#include "core/detection/edge_touch.h"
#include "core/model/model.h"

#include <algorithm>

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
    // Set later: to fill them with zeros here, or to copy the touch, cost a tenth of the law's time.
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
/// Differs from the paper: there the threshold is 0 without gravity, as impulses store nothing. Loads and walls press joints then too, and one that had taken an impulse
/// would obey impulses for ever: without its stiffness, without its roughness, and with any force where a wall moves. A point that touches first has no
/// force yet, so that its impact is one.
template <typename R>
[[nodiscard]] inline R load_velocity(R last_normal, R inverse_mass_normal, R dt)
{
    return dt * abs(last_normal) * inverse_mass_normal;
}

/// Masses of blocks in the threshold velocity. A fixed block may keep its mass, but never turns: where the paper's ground counts,
/// m_c = m/2 without levers.
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
/// In line, as the next two: calls would cost the force law instructions (core/tried.md).
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

/// Of the size of the smaller block: rock whose springs an impact would press by more does not keep them. (A block on a stone of a thousandth of its mass.)
inline constexpr double bearable_share = 0.05;

/// Standing rock keeps its springs, see RegimeRule, unless a loose block would press them by more than they bear,
///
///   v sqrt(m / (K_N L))        m: of the loose block
///
/// or has made it faster than by a fall through its own size.
template <typename P>
[[gnu::always_inline]] inline MaskOf<P> leave_to_springs(MaskOf<P> fast, const BasicContactGroup<P>& g, P speed_squared,
                                                         const Model& model, const Blocks& blocks)
{
    const double distance = model.convergence.loose_distance;
    const auto bears = [&](int j, Index loose, double squared)
    {
        const double stiffness = 2.0 * g.joint->law.normal_stiffness.v[j] * g.length.v[j];
        const double most = bearable_share * std::min(model.size(g.ref[j]), model.size(g.inc[j]));
        return squared * model.mass[loose] < stiffness * most * most;
    };
    const double weight = model.gravity.isZero(0.0) ? 9.81 : model.gravity.norm();
    const auto is_slow = [&](int j, double squared)
    { return squared < 2.0 * weight * std::min(model.size(g.ref[j]), model.size(g.inc[j])); };
    const auto keeps = [&](int j, double squared)
    {
        const Index a = g.ref[j], b = g.inc[j];
        const bool loose_a = blocks.is_loose(a, distance), loose_b = blocks.is_loose(b, distance);
        const bool standing = (blocks.is_free(a) && !loose_a) || (blocks.is_free(b) && !loose_b);
        const double size = loose_a ? model.size(a) : loose_b ? model.size(b) : 0.0;
        return standing && squared > gentle_impact * gentle_impact * model.gravity.norm() * size &&
               (loose_a || loose_b ? bears(j, loose_a ? a : b, squared) : is_slow(j, squared));
    };
    for (int j = 0; j < P::width; ++j)
        if (fast.has(j) && keeps(j, speed_squared.v[j]))
            fast.clear(j);
    return fast;
}

/// Corners on corners keep theirs, see RegimeRule: contacts shorter than two length floors.
template <typename P>
[[gnu::always_inline]] inline MaskOf<P> leave_corners_to_springs(MaskOf<P> fast, const BasicContactGroup<P>& g, const Model& model,
                                                                 const Blocks& blocks)
{
    const auto lies = [&](Index block) { return !blocks.is_loose(block, drawn_share * model.size(block)); };
    const MaskOf<P> is_short = g.growth < P(1.0);
    for (int j = 0; j < P::width; ++j)
        if (fast.has(j) && is_short.has(j) && lies(g.ref[j]) && lies(g.inc[j]))
            fast.clear(j);
    return fast;
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

/// The same of the approach alone.
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
    // The elastic part only adds: at rest nothing more needs to be known.
    const double least = threshold.least();
    if (!any(speed > P(least * least)))
        return none;
    MaskOf<P> fast = are_fast(g, speed, model, blocks, threshold);
    if (threshold.corners_keep_springs && any(fast & (g.growth < P(1.0))))
        fast = leave_corners_to_springs(fast, g, model, blocks);
    return threshold.rock_keeps_springs && any(fast) ? leave_to_springs(fast, g, speed, model, blocks) : fast;
}
}  // namespace hdem
