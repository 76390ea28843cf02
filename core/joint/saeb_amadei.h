#pragma once
/// Saeb and Amadei's law: asperities are climbed or sheared off in a share that depends on the normal stress.

#include "core/joint/normal_closure.h"

namespace hdem
{
struct SaebAmadeiInput
{
    double shear_stiffness = 0.0;  ///< K_S [Pa/m]
    double rock_strength = 0.0;    ///< sigma_T: stress at which all asperities are sheared off [Pa]
    double friction = 0.0;         ///< phi_u [deg]
    double roughness = 0.0;        ///< i_0 [deg]
    double rock_cohesion = 0.0;    ///< s_0 [Pa]
    double rock_friction = 0.0;    ///< phi_0 [deg]
    double residual_slip = 1e-2;   ///< u_r: slip at which dilation stops and the residual strength is reached [m]
    double residual_share = 1.0;   ///< B_0: residual over peak strength at no stress
};

/// Saeb & Amadei (1992), after Ladanyi & Archambault (1970), with x = sigma / sigma_T:
///
///   tau_p = sigma tan(phi_u + i) (1 - a_s) + a_s (s_0 + sigma tan phi_0),  1 - a_s = (1 - x)^1.5,  tan i = (1 - x)^4 tan i_0
///   tau_r = tau_p (B_0 + (1 - B_0) x)
///   w = min(|u_p|, u_r) (1 - x)^4 tan i_0
///
/// w depends on sigma, so sigma = N(closure + w) is solved by Newton steps: the error is monotone and concave in sigma, and from below
/// they converge without overshoot. Slip falls from tau_p to tau_r in proportion to the greatest |u_p|, up to u_r.
/// The asperities' compression stores energy, which `energy` contains: with G = integral of (1 - x)^4 over sigma,
/// tan i_0 |u_p| (G - sigma (1 - x)^4).
///
/// Memory: state is the greatest |u_p|; turn and broken mean nothing.
/// Differs from the source: u is the plastic slip, so that elastic shear does not dilate; the share of the residual strength grows from the
/// first slip on.
/// @see verification/unit/core/joint/saeb_amadei_test.cpp
struct SaebAmadei
{
    enum Number : int
    {
        shear_stiffness = curve_numbers,
        shear_compliance,  ///< 1 / K_S
        rock_strength,
        friction,   ///< tan phi_u
        roughness,  ///< tan i_0
        rock_cohesion,
        rock_friction,  ///< tan phi_0
        residual_slip,
        residual_share,
        strength_share  ///< 1; under strength reduction by F 1/F: tau_p and tau_r are multiplied by it
    };

    [[nodiscard]] static JointNumbers numbers(const SaebAmadeiInput& in, JointNumbers n)
    {
        n[shear_stiffness] = in.shear_stiffness;
        n[shear_compliance] = compliance_of(in.shear_stiffness);
        n[rock_strength] = in.rock_strength;
        n[friction] = tan(radians(in.friction));
        n[roughness] = tan(radians(in.roughness));
        n[rock_cohesion] = in.rock_cohesion;
        n[rock_friction] = tan(radians(in.rock_friction));
        n[residual_slip] = in.residual_slip;
        n[residual_share] = in.residual_share;
        n[strength_share] = 1.0;
        return n;
    }

    /// A value and its derivative by sigma.
    template <typename R>
    struct Rated
    {
        R value, rate;
    };

    /// tan i
    template <typename R>
    [[nodiscard]] static Rated<R> slope(const BasicJointNumbers<R>& n, R normal)
    {
        const R left = max(R(1.0) - normal / n[rock_strength], R(0.0)), cube = left * left * left * n[roughness];
        return {cube * left, R(-4.0) * cube / n[rock_strength]};
    }

    /// Strength; worn = min(greatest |u_p| / u_r, 1).
    template <typename R>
    [[nodiscard]] static Rated<R> strength(const BasicJointNumbers<R>& n, R normal, R worn)
    {
        using std::sqrt;
        const R one = 1.0, x = min(normal / n[rock_strength], one), root = sqrt(one - x);
        const R whole = (one - x) * root, whole_rate = R(-1.5) * root / n[rock_strength];
        const Rated<R> i = slope(n, normal);
        const R phi = n[friction], nearly = one / (one - phi * i.value);
        const R climb = (phi + i.value) * nearly, climb_rate = (one + phi * phi) * nearly * nearly * i.rate;
        const R rock = n[rock_cohesion] + normal * n[rock_friction];
        const R peak = normal * climb * whole + (one - whole) * rock;
        const R peak_rate = climb * whole + normal * (climb_rate * whole + climb * whole_rate) + (one - whole) * n[rock_friction] -
                            whole_rate * rock;
        const R lost = (one - n[residual_share]) * worn, kept = one - lost * (one - x);
        const R share = n[strength_share];
        return {share * (peak * kept), share * (peak_rate * kept + select(x < one, peak * lost / n[rock_strength], R(0.0)))};
    }

    /// sigma at a closure and a slip u >= 0, from a guess.
    template <typename Curve, typename R>
    [[nodiscard]] static R normal_stress(const BasicJointNumbers<R>& n, R closure, R u, R guess)
    {
        const R zero = 0.0;
        const R most = max(Curve::at(n, closure + u * n[roughness]).stress, zero);
        const R least = max(Curve::at(n, max(closure, zero)).stress, zero);
        R sigma = max(min(max(guess, least), most), R(1e-9) * most);
        for (int k = 0; k < 40; ++k)
        {
            const R v = Curve::closure_under(n, sigma);
            const Rated<R> i = slope(n, sigma);
            const R rate = safe_ratio(R(1.0), Curve::at(n, v).stiffness) - u * i.rate;
            const R better = min(max(sigma - (v - u * i.value - closure) / rate, R(1e-9) * most), most);
            const auto moves = magnitude(better - sigma) > R(4e-16) * most;
            sigma = select(moves, better, sigma);  // a lane does not depend on the others
            if (!any(moves))
                break;
        }
        return sigma;
    }

    /// G, the integral of (1 - x)^4 over sigma.
    template <typename R>
    [[nodiscard]] static R lifted(const BasicJointNumbers<R>& n, R normal)
    {
        const R left = max(R(1.0) - normal / n[rock_strength], R(0.0)), square = left * left;
        return n[rock_strength] * R(0.2) * (R(1.0) - square * square * left);
    }

    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress) { return strength(n, stress, 0.0).value; }
    [[nodiscard]] static double damage_of(const JointNumbers& n, const JointMemory& m)
    {
        return min(m.state / n[residual_slip], 1.0);
    }

    static void weaken(JointNumbers& n, double factor) { n[strength_share] /= factor; }
    static void keep_peak(JointNumbers& n) { n[residual_share] = 1.0; }
    [[nodiscard]] static bool loses_strength(const JointNumbers& n) { return n[residual_share] < 1.0; }
    static void stiffen(JointNumbers& n, double times)
    {
        n[shear_stiffness] *= times;
        n[shear_compliance] /= times;
    }

    template <typename Curve, typename R>
    [[nodiscard]] static BasicJointStress<R> react(const BasicJointNumbers<R>& n, const BasicJointStep<R>& step,
                                                   BasicJointMemory<R>& m)
    {
        const R zero = 0.0, one = 1.0, half = 0.5, k = n[shear_stiffness], u_r = n[residual_slip];
        const R trial = step.last_shear - k * step.slide, sign = direction_of(trial), slipped = sign * m.slip;
        const R u = min(magnitude(m.slip), u_r);
        const auto open = step.closure + u * n[roughness] <= zero;
        const R before = normal_stress<Curve>(n, step.closure, u, step.last_normal);
        const R last_opening = u * slope(n, min(max(step.last_normal, zero), n[rock_strength])).value;

        // Return with the rates of the trial state.
        const Rated<R> now_strong = strength(n, before, min(m.state / u_r, one)), i = slope(n, before);
        const R compliance = safe_ratio(one, Curve::at(n, Curve::closure_under(n, before)).stiffness) - u * i.rate;
        const R coupling = now_strong.rate * i.value / compliance;
        const R fresh = strength(n, before, zero).value - strength(n, before, one).value;
        const R a = max(slipped, zero), known = max(min(m.state, u_r) - a, zero);
        const std::array<R, 5> way = slip_along<R, 5>(magnitude(trial) - now_strong.value, safe_ratio(magnitude(trial), k),
                                                      {{{max(-u_r - slipped, zero), k},
                                                        {max(-max(slipped, -u_r), zero), k - coupling},
                                                        {known, k + coupling},
                                                        {max(u_r - a - known, zero), k + coupling - fresh / u_r},
                                                        {R(no_limit), k}}});
        const R lambda = ((way[0] + way[1]) + (way[2] + way[3])) + way[4], end = m.slip + sign * lambda;

        BasicJointStress<R> now;
        const R end_u = min(magnitude(end), u_r), greatest = max(m.state, magnitude(end));
        now.normal = before;
        if (any(lambda > zero))
            now.normal = select(lambda > zero, normal_stress<Curve>(n, step.closure, end_u, before), before);
        const Rated<R> end_i = slope(n, now.normal);
        now.opening = end_u * end_i.value;
        const BasicCurvePoint<R> spring = Curve::at(n, Curve::closure_under(n, now.normal));
        const R end_lift = lifted(n, now.normal), last_lift = lifted(n, max(step.last_normal, zero));
        now.energy = spring.energy + n[roughness] * end_u * end_lift - end_u * now.normal * end_i.value;
        now.normal_stiffness = one / (safe_ratio(one, spring.stiffness) - end_u * end_i.rate);
        now.shear = trial - sign * (k * lambda);
        now.strength = strength(n, now.normal, min(greatest / u_r, one)).value;
        now.slid = sign * lambda;
        now.shear_compliance = n[shear_compliance];
        now.heat = half * ((step.last_shear + now.shear) * now.slid - n[roughness] * (last_lift + end_lift) * (end_u - u));
        now.freed = zero;
        empty_where_open(open, step, last_opening, now);
        m.slip = select(open, m.slip, end);
        m.state = select(open, m.state, greatest);
        return now;
    }
};
}  // namespace hdem
