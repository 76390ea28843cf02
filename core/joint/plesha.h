#pragma once
/// Plesha's law: asperities that are climbed, and worn by the work of slip.

#include "core/joint/normal_closure.h"

namespace hdem
{
struct PleshaInput
{
    double shear_stiffness = 0.0;  ///< K_S [Pa/m]
    double friction = 0.0;         ///< phi [deg]
    double roughness = 0.0;        ///< alpha_0 [deg]
    double wear = 0.0;             ///< C [m^2/J]
};

/// Plesha (1987):
///
///   tau_max = sigma tan(phi + s alpha),  dw = tan(s alpha) d lambda,  alpha = alpha_0 exp(-C W_p),  W_p = integral of tau du_p
///
/// s = 1 where slip leads away from u_p = 0, -1 where it leads back. alpha is that of the cycle's beginning. Slip through u_p = 0 is split
/// there: beyond it the joint must first reach its greater strength.
///
/// Memory: state is W_p [J/m^2]; opening is w; turn and broken mean nothing.
/// Differs from the source: the strength on the way back is at least 0 (alpha > phi would push).
/// @pre  K_N tan(phi - alpha) tan(alpha) < K_S, else the joint snaps back to u_p = 0 on reversal
/// @see  verification/unit/core/joint/plesha_test.cpp
struct Plesha
{
    enum Number : int
    {
        shear_stiffness = curve_numbers,
        shear_compliance,  ///< 1 / K_S
        friction,          ///< tan phi
        roughness,         ///< alpha_0 [rad]
        wear,              ///< C [m^2/J]
        strength_share     ///< 1; under strength reduction by F 1/F: tau_max is multiplied by it
    };

    [[nodiscard]] static JointNumbers numbers(const PleshaInput& in, JointNumbers n)
    {
        n[shear_stiffness] = in.shear_stiffness;
        n[shear_compliance] = compliance_of(in.shear_stiffness);
        n[friction] = tan(radians(in.friction));
        n[roughness] = radians(in.roughness);
        n[wear] = in.wear;
        n[strength_share] = 1.0;
        return n;
    }

    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress)
    {
        const double tilt = tan(n[roughness]);
        return stress * n[strength_share] * (n[friction] + tilt) / (1.0 - n[friction] * tilt);
    }
    [[nodiscard]] static double damage_of(const JointNumbers& n, const JointMemory& m) { return 1.0 - exp(-n[wear] * m.state); }

    static void weaken(JointNumbers& n, double factor) { n[strength_share] /= factor; }
    static void keep_peak(JointNumbers& n) { n[wear] = 0.0; }
    [[nodiscard]] static bool loses_strength(const JointNumbers& n) { return n[wear] > 0.0 && n[roughness] > 0.0; }
    static void stiffen(JointNumbers& n, double times)
    {
        n[shear_stiffness] *= times;
        n[shear_compliance] /= times;
    }

    template <typename Curve, typename R>
    [[nodiscard]] static BasicJointStress<R> react(const BasicJointNumbers<R>& n, const BasicJointStep<R>& step,
                                                   BasicJointMemory<R>& m)
    {
        const R zero = 0.0, one = 1.0, k = n[shear_stiffness];
        const R w = m.opening;
        const R trial = step.last_shear - k * step.slide, sign = direction_of(trial), slipped = sign * m.slip;
        const R tilt = tan(n[roughness] * exp(-n[wear] * m.state)), phi = n[friction];
        const R share = n[strength_share];
        const R mu_up = share * ((phi + tilt) / (one - phi * tilt)), mu_down = share * max((phi - tilt) / (one + phi * tilt), zero);
        const BasicCurvePoint<R> before = Curve::at(n, step.closure + w);
        const auto open = before.stress <= zero;

        const R coupling = before.stiffness * tilt;
        const R left = max(-slipped, zero), most = safe_ratio(magnitude(trial), k);
        const std::array<R, 2> down = slip_along<R, 2>(select(left > zero, magnitude(trial) - before.stress * mu_down, zero), most,
                                                       {{{left, k - coupling * mu_down}, {zero, k}}});
        const R bottom = max(before.stress - coupling * down[0], zero);
        const auto passed = !(down[0] + slipped < zero);
        const std::array<R, 1> up = slip_along<R, 1>(select(passed, (magnitude(trial) - k * down[0]) - bottom * mu_up, zero),
                                                     most - down[0], {{{R(no_limit), k + coupling * mu_up}}});
        const R lambda = down[0] + up[0];

        BasicJointStress<R> now;
        now.opening = w + tilt * (up[0] - down[0]);
        const BasicCurvePoint<R> after = Curve::at(n, step.closure + now.opening);
        now.normal = max(after.stress, zero);
        now.energy = select(after.stress > zero, after.energy, zero);
        now.normal_stiffness = after.stiffness;
        now.shear = trial - sign * (k * lambda);
        const auto leads_back = slipped + lambda < zero;
        now.strength = now.normal * select(leads_back, mu_down, mu_up);
        now.slid = sign * lambda;
        now.shear_compliance = n[shear_compliance];
        now.heat = slip_heat(step, now, w);
        now.freed = zero;
        empty_where_open(open, step, w, now);
        m.state = select(open, m.state, m.state + max(R(0.5) * (step.last_shear + now.shear) * now.slid, zero));
        m.opening = now.opening;
        m.slip = select(open, m.slip, select(passed & (up[0] <= zero) & (left > zero), zero, m.slip + sign * lambda));
        return now;
    }
};
}  // namespace hdem
