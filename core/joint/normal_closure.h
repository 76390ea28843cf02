#pragma once
/// The normal spring of a joint: stress over closure, in total form.
///
/// Three curves with the same interface: `at` gives stress, stiffness and energy at a closure, `closure_under` the closure at a stress (for
/// the preload of rock under stress). Under tension all are linear with the stiffness at closure 0; a law without tension does not use that part.

#include "core/joint/functions.h"
#include "core/joint/joint_law.h"

namespace hdem
{
/// Positions of the normal spring's numbers; those of the law follow.
enum CurveNumber : int
{
    curve_stiffness,  ///< K_N at closure 0 [Pa/m]; PowerLaw: 0
    curve_scale,      ///< Hyperbolic: V_m [m]. PowerLaw: b = (1 - e) a [Pa^(1-e)/m]
    curve_exponent,   ///< PowerLaw: p = 1 / (1 - e)
    curve_cap,        ///< closure from which on the curve is a straight line [m]
    curve_cap_stress,
    curve_cap_stiffness,
    curve_cap_energy,
    curve_numbers
};

/// Stress [Pa], stiffness [Pa/m] and energy [J/m^2] at a closure.
template <typename R>
struct BasicCurvePoint
{
    R stress, stiffness, energy;
};

/// Beyond the cap the curve goes on along its tangent, below 0 along its first tangent.
template <typename R>
[[nodiscard]] inline BasicCurvePoint<R> with_straight_ends(const BasicJointNumbers<R>& n, R closure, const BasicCurvePoint<R>& p)
{
    const R zero = 0.0, half = 0.5;
    const R beyond = max(closure - n[curve_cap], zero);
    const auto capped = beyond > zero;
    const auto pulled = closure < zero;
    const R line = n[curve_cap_stress] + n[curve_cap_stiffness] * beyond;
    const R line_energy = n[curve_cap_energy] + half * (n[curve_cap_stress] + line) * beyond;
    const R k = n[curve_stiffness];
    return {select(pulled, k * closure, select(capped, line, p.stress)),
            select(pulled, k, select(capped, n[curve_cap_stiffness], p.stiffness)),
            select(pulled, half * k * closure * closure, select(capped, line_energy, p.energy))};
}

/// The inverse of the same.
template <typename R>
[[nodiscard]] inline R with_straight_ends(const BasicJointNumbers<R>& n, R stress, R closure)
{
    const R beyond = n[curve_cap] + (stress - n[curve_cap_stress]) / n[curve_cap_stiffness];
    const R pulled = safe_ratio(stress, n[curve_stiffness]);
    return select(stress < R(0.0), pulled, select(stress > n[curve_cap_stress], beyond, closure));
}

/// sigma = K V
struct Linear
{
    [[nodiscard]] static JointNumbers numbers(double stiffness)
    {
        JointNumbers n{};
        n[curve_stiffness] = stiffness;
        return n;
    }
    template <typename R>
    [[nodiscard]] static BasicCurvePoint<R> at(const BasicJointNumbers<R>& n, R closure)
    {
        const R stress = n[curve_stiffness] * closure;
        return {stress, n[curve_stiffness], R(0.5) * stress * closure};
    }
    template <typename R>
    [[nodiscard]] static R closure_under(const BasicJointNumbers<R>& n, R stress)
    {
        return safe_ratio(stress, n[curve_stiffness]);
    }
};

/// Bandis, Lumsden & Barton (1983), with x = V / V_m:
///
///   sigma = K_ni V / (1 - x),  K_N = K_ni / (1 - x)^2,  energy K_ni V_m^2 (-x - ln(1 - x))
///
/// K_ni stiffness at no stress [Pa/m]   V_m greatest closure [m]
///
/// Differs from the source: a straight line beyond x = 0.95, so K_N is at most 400 K_ni, or beyond a stress that is given. Unloads along the same curve.
struct Hyperbolic
{
    static constexpr double greatest_share = 0.95;

    /// @param straight_from  stress from which on the curve is a straight line [Pa]
    [[nodiscard]] static JointNumbers numbers(double stiffness, double greatest_closure, double straight_from = no_limit)
    {
        JointNumbers n{};
        n[curve_stiffness] = stiffness;
        n[curve_scale] = greatest_closure;
        n[curve_cap] = min(greatest_share, straight_from / (stiffness * greatest_closure + straight_from)) * greatest_closure;
        const BasicCurvePoint<double> cap = curve(n, n[curve_cap]);
        n[curve_cap_stress] = cap.stress;
        n[curve_cap_stiffness] = cap.stiffness;
        n[curve_cap_energy] = cap.energy;
        return n;
    }
    template <typename R>
    [[nodiscard]] static BasicCurvePoint<R> at(const BasicJointNumbers<R>& n, R closure)
    {
        return with_straight_ends(n, closure, curve(n, min(max(closure, R(0.0)), n[curve_cap])));
    }
    template <typename R>
    [[nodiscard]] static R closure_under(const BasicJointNumbers<R>& n, R stress)
    {
        const R s = max(stress, R(0.0));
        return with_straight_ends(n, stress, s * n[curve_scale] / (n[curve_stiffness] * n[curve_scale] + s));
    }

  private:
    /// Energy without loss of digits at small x: -x - ln(1 - x) = x s + (2 atanh(s) - 2 s) with s = x / (2 - x).
    template <typename R>
    [[nodiscard]] static BasicCurvePoint<R> curve(const BasicJointNumbers<R>& n, R closure)
    {
        const R one = 1.0, x = closure / n[curve_scale], left = one - x;
        const R s = x / (one + left);
        const R small = s * (x + atanh_rest(min(s, R(0.18))));
        const R share = select(s < R(0.17), small, -x - log(left));
        const R k = n[curve_stiffness] / left;
        return {k * closure, k / left, n[curve_stiffness] * n[curve_scale] * n[curve_scale] * share};
    }
};

/// K_N = a sigma^e up to a greatest stiffness, 0 <= e < 1. Integrated from closure 0, with b = (1 - e) a and p = 1 / (1 - e):
///
///   sigma = (b V)^p,  K_N = p sigma / V,  energy sigma V / (p + 1)
///
/// Cundall & Hart (1984). The stiffness at no stress is 0, so a joint with this curve bears no tension.
struct PowerLaw
{
    /// a [Pa^(1-e)/m]; `greatest` [Pa/m]
    [[nodiscard]] static JointNumbers numbers(double a, double e, double greatest)
    {
        JointNumbers n{};
        n[curve_scale] = (1.0 - e) * a;
        n[curve_exponent] = 1.0 / (1.0 - e);
        n[curve_cap] = n[curve_cap_stress] = no_limit;
        n[curve_cap_stiffness] = greatest;
        if (e > 0.0)
        {
            n[curve_cap_stress] = power(greatest / a, 1.0 / e);
            n[curve_cap] = power(n[curve_cap_stress], 1.0 - e) / n[curve_scale];
            n[curve_cap_energy] = n[curve_cap_stress] * n[curve_cap] / (n[curve_exponent] + 1.0);
        }
        return n;
    }
    template <typename R>
    [[nodiscard]] static BasicCurvePoint<R> at(const BasicJointNumbers<R>& n, R closure)
    {
        const R v = min(max(closure, R(0.0)), n[curve_cap]);
        const R p = n[curve_exponent];
        const R stress = select(v > R(0.0), power(n[curve_scale] * v, p), R(0.0));
        return with_straight_ends(n, closure, {stress, safe_ratio(p * stress, v), stress * v / (p + R(1.0))});
    }
    template <typename R>
    [[nodiscard]] static R closure_under(const BasicJointNumbers<R>& n, R stress)
    {
        const R s = max(stress, R(1e-200));
        return select(stress > R(0.0), with_straight_ends(n, stress, power(s, R(1.0) / n[curve_exponent]) / n[curve_scale]),
                      R(0.0));
    }
};
}  // namespace hdem
