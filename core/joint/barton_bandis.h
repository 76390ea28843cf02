#pragma once
/// Barton-Bandis: shear strength of a rough joint from JRC and JCS.

#include "core/joint/normal_closure.h"

namespace hdem
{
/// Roughness and strength of the joint walls, as measured on a length of 0.1 m.
struct BartonBandisInput
{
    double shear_stiffness = 0.0;    ///< K_S [Pa/m]; raised to the steepest part of the mobilisation curve
    double roughness = 0.0;          ///< JRC_0 [-]
    double wall_strength = 0.0;      ///< JCS_0 [Pa]
    double residual_friction = 0.0;  ///< phi_r [deg]
    double length = 0.1;             ///< L, the joint's block size [m]
    double damage = 2.0;             ///< M: 1 at low, 2 at high stress
    double normal_stress = 1e6;      ///< greatest sigma expected, for K_S [Pa]
};

/// Bandis's closure: aperture, initial stiffness, greatest closure; SI units.
struct BandisClosure
{
    double aperture, stiffness, greatest;
};

/// From JRC, JCS and the strength of the rock; cycle 1 to 3 of loading.
///
///   a_j = JRC/5 (0.2 sigma_c/JCS - 0.1) mm,  K_ni = -7.15 + 1.75 JRC + 0.02 JCS/a_j MPa/mm,  V_m = A + B JRC + C (JCS/a_j)^D mm
///
/// Bandis, Lumsden & Barton (1983); MPa and mm inside.
[[nodiscard]] inline BandisClosure bandis_closure(double roughness, double wall_strength, double rock_strength, int cycle)
{
    constexpr double table[3][4] = {
        {-0.2960, -0.0056, 2.2410, -0.2450}, {-0.1005, -0.0073, 1.0082, -0.2301}, {-0.1032, -0.0074, 1.1350, -0.2510}};
    const auto& [a, b, c, d] = table[cycle - 1];
    const double aperture = roughness / 5.0 * (0.2 * rock_strength / wall_strength - 0.1), ratio = 1e-6 * wall_strength / aperture;
    return {1e-3 * aperture, 1e9 * (-7.15 + 1.75 * roughness + 0.02 * ratio), 1e-3 * (a + b * roughness + c * power(ratio, d))};
}

/// Barton & Choubey (1977), Barton, Bandis & Bakhtar (1985):
///
///   i = JRC_n log10(JCS_n / sigma),  0 <= i <= 70 deg - phi_r        roughness angle
///   tau_max = sigma tan(phi_r + m i),  m = m(delta / delta_p)        mobilised strength; below 0.3 delta_p: sigma tan(phi_r delta / 0.3 delta_p)
///   dw = tan(m i / M) d delta                                        dilation
///   JRC_n = JRC_0 (L/L_0)^(-0.02 JRC_0),  JCS_n = JCS_0 (L/L_0)^(-0.03 JRC_0),  delta_p = L/500 (JRC_n/L)^0.33
///
/// delta is the greatest total shear displacement |u_p + tau/K_S| so far. It is known before the return to the strength, so no iteration
/// is needed. dw is booked in proportion to slip, at the rate that holds for constant stress. Where sigma grows as the joint opens, less of d delta is slip.
/// The remainder of dw is carried over: it raises the rate, so that it is made up within 0.01 delta_p of slip.
/// After a reversal: elastic, then slip at m(delta) with no gain. The opening stays: given back, it would unload the stiff normal spring faster
/// than the shear spring can follow (K_N tan phi dw/du_p is ten times K_S in the example of the test), and each reversal would be a jump.
/// K_S is raised so that each part of the curve leaves slip enough to pay for its dilation under sigma = normal_stress.
///
/// Memory: state is delta; opening is w; turn is the remainder of dw [m]; broken means nothing.
/// Differs from the source: no hysteresis of closure; |u_p + tau/K_S| counts, which on reversal is less than |u_p| + |tau|/K_S.
/// @see verification/unit/core/joint/barton_bandis_test.cpp
struct BartonBandis
{
    enum Number : int
    {
        shear_stiffness = curve_numbers,
        shear_compliance,    ///< 1 / K_S
        residual_friction,   ///< phi_r [rad]
        roughness,           ///< i per unit of the natural logarithm [rad]
        log_strength,        ///< ln JCS_n
        greatest_roughness,  ///< greatest i [rad]
        peak_displacement,   ///< delta_p [m]
        per_displacement,    ///< 1 / delta_p [1/m]
        per_damage,          ///< 1 / M
        scaled_roughness,    ///< JRC_n, for reports
        strength_share       ///< 1; under strength reduction by F 1/F: tau_max is multiplied by it
    };
    static_assert(strength_share + 1 < joint_numbers);  // the last is that of user_law.h

    static constexpr double first_mobilised = 0.3;  ///< delta / delta_p from which on roughness acts
    static constexpr double left_within = 0.01;     ///< slip / delta_p within which the remainder of dw is made up

    /// m over x = delta / delta_p, from 0.3 on.
    template <typename R>
    [[nodiscard]] static R mobilised(R x)
    {
        constexpr double part[7][3] = {{0.3, 0.6, 0.75},  {0.6, 1.0, 0.25},   {1.0, 2.0, -0.15},  {2.0, 4.0, -0.15},
                                       {4.0, 10.0, -0.2}, {10.0, 25.0, -0.1}, {25.0, 100.0, -0.4}};  // from, to, change of m
        R m = 0.0;
        for (const auto& [from, to, change] : part)
            m += R(change / (to - from)) * min(max(x - R(from), R(0.0)), R(to - from));
        return m;
    }

    /// phi_r + m i [rad]
    template <typename R>
    [[nodiscard]] static R friction_angle(const BasicJointNumbers<R>& n, R x, R i)
    {
        return base_angle(n, x) + mobilised(x) * i;
    }
    /// Mobilised part of phi_r [rad].
    template <typename R>
    [[nodiscard]] static R base_angle(const BasicJointNumbers<R>& n, R x)
    {
        return n[residual_friction] * min(x * R(1.0 / first_mobilised), R(1.0));
    }

    [[nodiscard]] static JointNumbers numbers(const BartonBandisInput& in, JointNumbers n)
    {
        constexpr double ln10 = 2.302585092994046;
        const double scale = in.length / 0.1;
        n[scaled_roughness] = in.roughness * power(scale, -0.02 * in.roughness);
        n[residual_friction] = radians(in.residual_friction);
        n[roughness] = radians(n[scaled_roughness]) / ln10;
        n[log_strength] = log(in.wall_strength * power(scale, -0.03 * in.roughness));
        n[greatest_roughness] = radians(70.0) - n[residual_friction];
        n[peak_displacement] = in.length / 500.0 * power(n[scaled_roughness] / in.length, 0.33);
        n[per_damage] = 1.0 / in.damage;
        n[strength_share] = 1.0;
        n[shear_stiffness] = max(in.shear_stiffness, steepest(n, in.normal_stress));
        return with_inverses(n);
    }
    [[nodiscard]] static JointNumbers with_inverses(JointNumbers n)
    {
        n[per_displacement] = 1.0 / n[peak_displacement];
        n[shear_compliance] = compliance_of(n[shear_stiffness]);
        return n;
    }

    static void settle(JointNumbers& n) { n = with_inverses(n); }

    /// Stiffness that the curve asks for at the ends of its rising parts [Pa/m].
    [[nodiscard]] static double steepest(const JointNumbers& n, double normal)
    {
        const double i = min(max(n[roughness] * (n[log_strength] - log(normal)), 0.0), n[greatest_roughness]);
        const double slope[3] = {n[residual_friction] / 0.3, 2.5 * i, 0.625 * i}, end[3] = {0.3, 0.6, 1.0};
        double most = 0.0;
        for (int k = 0; k < 3; ++k)
        {
            const double t = tan(friction_angle(n, end[k], i)), dilation = tan(mobilised(end[k]) * i * n[per_damage]);
            most = max(most, normal * slope[k] * (1.0 + t * t) / (n[peak_displacement] * (1.0 - dilation / t)));
        }
        return most;
    }

    /// tan(m i / M) while delta grows from `from` to `to`.
    template <typename R>
    [[nodiscard]] static R dilation_between(const BasicJointNumbers<R>& n, R from, R to, R i)
    {
        return tan(mobilised(R(0.5) * (from + to) * n[per_displacement]) * i * n[per_damage]);
    }

    /// dw/du_p over the same step. Under constant stress, the share 1 - (d tau_max/d delta) / K_S of d delta is slip. Dilation takes no more work than slip gives.
    /// @param t     tan(angle), not reduced
    /// @param left  remainder of dw [m]
    template <typename R>
    [[nodiscard]] static R rate_of_slip(const BasicJointNumbers<R>& n, R from, R to, R i, R angle, R t, R normal, R dilation,
                                        R left)
    {
        const R one = 1.0, way = to - from;
        const R turned = angle - friction_angle(n, from * n[per_displacement], i);
        const R gain = n[strength_share] * normal * turned * (one + t * t) * (one - t * turned);  // in the middle of the step
        const R rate = safe_ratio(dilation, one - safe_ratio(gain, n[shear_stiffness] * way));
        return max(min(rate + left / max(R(left_within) * n[peak_displacement], way), n[strength_share] * t), R(0.0));
    }

    /// i [rad]
    [[nodiscard]] static double roughness_angle(const JointNumbers& n, double stress)
    {
        const double free = n[roughness] * (n[log_strength] - log(max(stress, 1.0)));
        return min(max(free, 0.0), n[greatest_roughness]);
    }
    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress)
    {
        return stress * n[strength_share] * tan(n[residual_friction] + roughness_angle(n, stress));
    }
    [[nodiscard]] static double damage_of(const JointNumbers& n, const JointMemory& m)
    {
        const double x = m.state / n[peak_displacement];
        return x > 1.0 ? 1.0 - mobilised(x) : 0.0;
    }
    /// delta of a joint that bears a shear stress as drawn: that at which this stress is mobilised, at most delta_p [m].
    [[nodiscard]] static double drawn_state(const JointNumbers& n, double normal, double shear)
    {
        if (normal <= 0.0 || shear == 0.0)
            return 0.0;
        const double i = roughness_angle(n, normal);
        double low = 0.0, high = 1.0;  // of delta / delta_p
        for (int k = 0; k < 60; ++k)
        {
            const double x = 0.5 * (low + high);
            const bool bears = normal * n[strength_share] * tan(friction_angle(n, x, i)) >= magnitude(shear);
            (bears ? high : low) = x;
        }
        return high * n[peak_displacement];
    }

    /// Let the joint slip until it bears a shear stress, at most to its peak.
    static void mobilise(const JointNumbers& n, double normal, double shear, JointMemory& m)
    {
        const double delta = drawn_state(n, normal, shear);
        if (delta <= m.state)
            return;
        m.state = delta;
        m.slip = direction_of(shear) * delta - shear * n[shear_compliance];
    }

    static void weaken(JointNumbers& n, double factor) { n[strength_share] /= factor; }
    static void stiffen(JointNumbers& n, double times)
    {
        n[shear_stiffness] *= times;
        n[shear_compliance] /= times;
    }

    template <typename Curve, typename R>
    [[nodiscard]] static BasicJointStress<R> react(const BasicJointNumbers<R>& n, const BasicJointStep<R>& step,
                                                   BasicJointMemory<R>& m)
    {
        const R zero = 0.0, k = n[shear_stiffness];
        const R w = m.opening;
        const R trial = step.last_shear - k * step.slide, sign = direction_of(trial);
        const R delta = max(m.state, magnitude(m.slip + trial * n[shear_compliance]));
        const auto grows = delta > m.state;
        const BasicCurvePoint<R> before = Curve::at(n, step.closure + w);
        const auto open = before.stress <= zero;

        const R sigma = max(before.stress, R(1.0));  // [Pa]; the law has no meaning below
        const R x = delta * n[per_displacement];
        R free_i = zero, i = zero, share = zero;
        const bool is_rough = any(x > R(first_mobilised));  // else neither roughness nor dilation acts, as in most rock
        if (is_rough)
        {
            free_i = n[roughness] * (n[log_strength] - log(sigma));
            i = min(max(free_i, zero), n[greatest_roughness]);
            share = mobilised(x);
        }
        const R angle = base_angle(n, x) + share * i, whole = tan(angle), t = n[strength_share] * whole;
        const R excess = magnitude(trial) - before.stress * t;
        R mu = zero, dilation = zero, lambda = zero, rate = zero;
        if (is_rough && any(grows))
            rate = select(grows, dilation_between(n, m.state, delta, i), zero);
        if (any(excess > zero))  // most points of most cycles stick
        {
            lambda = max(excess, zero) * n[shear_compliance];
            mu = t;
            if (is_rough)
            {
                // d tau_max / d sigma; i falls as sigma grows.
                const R falls = select(i == free_i, (R(1.0) + whole * whole) * share * n[roughness], zero);
                mu = n[strength_share] * max(whole - falls, zero);
                dilation = select(grows, rate_of_slip(n, m.state, delta, i, angle, whole, sigma, rate, m.turn), zero);
                const R climbing = max(excess, zero) / (k + before.stiffness * mu * dilation);
                lambda = select(dilation > zero, climbing, lambda);
            }
        }

        BasicJointStress<R> now;
        now.opening = w + dilation * lambda;
        BasicCurvePoint<R> after = before;
        if (any(now.opening > w))
            after = Curve::at(n, step.closure + now.opening);
        now.normal = after.stress;
        now.energy = after.energy;
        now.normal_stiffness = after.stiffness;
        now.shear = trial - sign * (k * lambda);
        now.strength = max(before.stress * t + mu * (after.stress - before.stress), zero);
        now.slid = sign * lambda;
        now.shear_compliance = n[shear_compliance];
        now.heat = slip_heat(step, now, w);
        now.freed = zero;
        empty_where_open(open, step, w, now);
        m.slip += now.slid;
        m.turn = select(open, m.turn, m.turn + rate * (delta - m.state) - (now.opening - w));
        m.opening = now.opening;
        m.state = select(open, m.state, delta);
        return now;
    }
};
}  // namespace hdem
