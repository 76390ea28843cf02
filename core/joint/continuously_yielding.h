#pragma once
/// Continuously yielding joint: the shear stiffness falls towards a bounding strength that falls with slip.

#include "core/joint/normal_closure.h"

namespace hdem
{
struct ContinuouslyYieldingInput
{
    double shear_stiffness = 0.0;      ///< a_s: k_s = a_s sigma^e_s [Pa^(1-e_s)/m]
    double shear_exponent = 0.0;       ///< e_s [-]
    double greatest_stiffness = 1e12;  ///< bound of k_s [Pa/m]
    double friction = 0.0;             ///< phi [deg]
    double first_friction = 0.0;       ///< phi_m at first, no less than phi [deg]
    double roughness = 0.0;            ///< R: slip over which the roughness is lost [m]
};

/// Cundall & Hart (1984):
///
///   d tau = F k_s du_s,  F = (1 - tau / tau_m) / (1 - r),  tau_m = sigma tan phi_m sgn(du_s)
///   du_p = (1 - F) |du_s|,  d phi_m = -(phi_m - phi) du_p / R,  dw = tan(atan(|tau| / sigma) - phi) du_p, no less than 0
///   r = tau / tau_m, at most 0.75, set where sgn(du_s) changes
///
/// Both rates are integrated: phi_m = phi + (phi_m0 - phi) exp(-P / R) with P the sum of du_p, and with tau_m held over the step
///
///   tau = tau_m + (last tau - tau_m) exp(-k_s |du_s| / ((1 - r) |tau_m|))
///
/// which is stable for any step, so there are no substeps; tau_m is that of the middle of the step, with the stress
/// that dilation leads to. Dilation is not given back.
/// k_s is that of the last cycle's sigma; what the shear spring loses where k_s changes is booked as freed.
///
/// Memory: state is P [m]; turn is (1 - r) with the sign of du_s, 0 before the first slide; opening is w; broken means nothing.
/// Differs from the source: |tau| is cut to sigma tan phi_m0, so that a joint that is unloaded keeps no stress.
/// @see verification/unit/core/joint/continuously_yielding_test.cpp
struct ContinuouslyYielding
{
    enum Number : int
    {
        shear_factor = curve_numbers,  ///< a_s
        shear_exponent,                ///< e_s
        greatest_stiffness,
        friction_angle,  ///< phi [rad]
        lost_angle,      ///< phi_m0 - phi [rad]
        friction,        ///< tan phi
        first_friction,  ///< tan phi_m0
        roughness,       ///< 1 / R [1/m]
        strength_share   ///< 1; under strength reduction by F 1/F: tau_m is multiplied by it
    };

    [[nodiscard]] static JointNumbers numbers(const ContinuouslyYieldingInput& in, JointNumbers n)
    {
        n[shear_factor] = in.shear_stiffness;
        n[shear_exponent] = in.shear_exponent;
        n[greatest_stiffness] = in.greatest_stiffness;
        n[friction_angle] = radians(in.friction);
        n[lost_angle] = radians(in.first_friction - in.friction);
        n[roughness] = 1.0 / in.roughness;
        n[strength_share] = 1.0;
        settle(n);
        return n;
    }
    static void settle(JointNumbers& n)
    {
        n[friction] = tan(n[friction_angle]);
        n[first_friction] = tan(n[friction_angle] + n[lost_angle]);
    }

    template <typename R>
    [[nodiscard]] static R stiffness(const BasicJointNumbers<R>& n, R normal)
    {
        R k = n[shear_factor];
        if (any(n[shear_exponent] > R(0.0)))
            k = select(n[shear_exponent] > R(0.0), k * power(max(normal, R(1.0)), n[shear_exponent]), k);
        return min(k, n[greatest_stiffness]);
    }

    /// tau_m / sigma after the plastic path P: tan phi_m, or its share.
    template <typename R>
    [[nodiscard]] static R bound(const BasicJointNumbers<R>& n, R path)
    {
        return n[strength_share] * tan(n[friction_angle] + n[lost_angle] * exp(-path * n[roughness]));
    }

    /// tan(atan(slope) - phi), no less than 0, with the stress ratio that the whole strength would have.
    template <typename R>
    [[nodiscard]] static R dilation(const BasicJointNumbers<R>& n, R slope)
    {
        const R whole = slope / n[strength_share];
        return max((whole - n[friction]) / (R(1.0) + whole * n[friction]), R(0.0));
    }

    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress)
    {
        return stress * n[strength_share] * n[first_friction];
    }
    [[nodiscard]] static double damage_of(const JointNumbers& n, const JointMemory& m)
    {
        return 1.0 - exp(-m.state * n[roughness]);
    }

    static void weaken(JointNumbers& n, double factor) { n[strength_share] /= factor; }
    static void keep_peak(JointNumbers& n) { n[roughness] = 0.0; }
    [[nodiscard]] static bool loses_strength(const JointNumbers& n) { return n[roughness] > 0.0 && n[lost_angle] > 0.0; }
    static void stiffen(JointNumbers& n, double times)
    {
        n[shear_factor] *= times;
        n[greatest_stiffness] *= times;
    }

    template <typename Curve, typename R>
    [[nodiscard]] static BasicJointStress<R> react(const BasicJointNumbers<R>& n, const BasicJointStep<R>& step,
                                                   BasicJointMemory<R>& m)
    {
        const R zero = 0.0, one = 1.0, half = 0.5, w = m.opening;
        const BasicCurvePoint<R> before = Curve::at(n, step.closure + w);
        const auto open = before.stress <= zero;
        const R sigma = max(before.stress, R(1.0));
        const R k = stiffness(n, select(step.last_normal > zero, step.last_normal, sigma));

        const R most = sigma * (n[strength_share] * n[first_friction]), start = min(max(step.last_shear, -most), most);
        const R way = magnitude(step.slide), turned = direction_of(m.turn);
        const R sign = select(way > zero, -direction_of(step.slide), turned);
        const R tangent = bound(n, m.state), along = sign * start;
        const auto reverses = (m.turn == zero) | (!(sign == turned));
        const R left = select(reverses, max(one - along / (sigma * tangent), R(0.25)), magnitude(m.turn));  // 1 - r

        // Middle of the step with the stress of its beginning; then the whole with the stress that its dilation leads to.
        const auto approach = [&](R limit, R du) { return limit + (along - limit) * exp(-(k * du) / (left * limit)); };
        const R middle = approach(sigma * tangent, half * way);
        const R half_path = max(half * way - (middle - along) / k, zero);
        const R risen = sigma + before.stiffness * (dilation(n, middle / sigma) * (half_path + half_path));
        const R limit = risen * bound(n, m.state + half_path);
        const R end = approach(limit, way);

        BasicJointStress<R> now;
        now.shear = sign * end;
        now.slid = -step.slide - (now.shear - step.last_shear) / k;
        const R path = max(way - (end - along) / k, zero);
        now.opening = w + dilation(n, half * (along + end) / risen) * path;
        const BasicCurvePoint<R> after = Curve::at(n, step.closure + now.opening);
        now.normal = after.stress;
        now.energy = after.energy;
        now.normal_stiffness = after.stiffness;
        now.strength = after.stress * bound(n, m.state + path);
        now.shear_compliance = one / k;
        now.heat = slip_heat(step, now, w);
        now.freed = zero;
        empty_where_open(open, step, w, now);
        const R compliance = now.shear_compliance;
        now.shear_compliance = select(open, compliance, one / stiffness(n, now.normal));
        now.freed += shear_energy(now.shear, compliance) - shear_energy(now.shear, now.shear_compliance);
        m.slip += now.slid;
        m.state = select(open, m.state, m.state + path);
        m.turn = select(open | (way <= zero), m.turn, sign * left);
        m.opening = now.opening;
        return now;
    }
};
}  // namespace hdem
