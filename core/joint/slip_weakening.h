#pragma once
/// Linear slip weakening: friction falls with the length of the slip, to and fro, and stays at its residual value.

#include "core/joint/normal_closure.h"

namespace hdem
{
struct SlipWeakeningInput
{
    double shear_stiffness = 0.0;    ///< K_S [Pa/m]
    double friction = 0.0;           ///< phi, before any slip [deg]
    double residual_friction = 0.0;  ///< phi_r, no more than phi [deg]
    double weakening_length = 0.0;   ///< D: slip over which friction falls [m]
};

/// Ida (1972), Andrews (1976):
///
///   tau_max = sigma (tan phi_r + (tan phi - tan phi_r) max(1 - P / D, 0)),  P the sum of |du_p|
///
/// The return is exact: slip that crosses P = D is split there. Where K_S <= sigma (tan phi - tan phi_r) / D friction falls faster than the
/// spring unloads; the point then slips at once to P = D. There is no dilation, and friction does not come back.
///
/// Memory: state is P [m]; turn, opening and broken mean nothing.
/// @see  verification/unit/core/joint/slip_weakening_test.cpp
struct SlipWeakening
{
    enum Number : int
    {
        shear_stiffness = curve_numbers,
        shear_compliance,   ///< 1 / K_S
        residual_friction,  ///< tan phi_r
        lost_friction,      ///< tan phi - tan phi_r
        weakening           ///< 1 / D [1/m]; 0: friction stays
    };

    [[nodiscard]] static JointNumbers numbers(const SlipWeakeningInput& in, JointNumbers n)
    {
        n[shear_stiffness] = in.shear_stiffness;
        n[shear_compliance] = compliance_of(in.shear_stiffness);
        n[residual_friction] = tan(radians(in.residual_friction));
        n[lost_friction] = tan(radians(in.friction)) - n[residual_friction];
        n[weakening] = 1.0 / in.weakening_length;
        return n;
    }

    /// tan of the friction angle after the slip path P.
    template <typename R>
    [[nodiscard]] static R friction(const BasicJointNumbers<R>& n, R path)
    {
        return n[residual_friction] + n[lost_friction] * max(R(1.0) - path * n[weakening], R(0.0));
    }

    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress) { return stress * friction(n, 0.0); }
    [[nodiscard]] static double damage_of(const JointNumbers& n, const JointMemory& m) { return min(m.state * n[weakening], 1.0); }

    static void weaken(JointNumbers& n, double factor)
    {
        for (const int i : {residual_friction, lost_friction})
            n[i] /= factor;
    }
    static void keep_peak(JointNumbers& n) { n[weakening] = 0.0; }
    [[nodiscard]] static bool loses_strength(const JointNumbers& n) { return n[weakening] > 0.0 && n[lost_friction] > 0.0; }
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
        const BasicCurvePoint<R> curve = Curve::at(n, step.closure);
        const auto open = curve.stress <= zero;
        const R trial = step.last_shear - k * step.slide, sign = direction_of(trial), most = safe_ratio(magnitude(trial), k);
        const R left = max(compliance_of(n[weakening]) - m.state, zero), fall = curve.stress * n[lost_friction] * n[weakening];
        const std::array<R, 2> way = slip_along<R, 2>(magnitude(trial) - curve.stress * friction(n, m.state), most,
                                                      {{{left, k - fall}, {R(no_limit), k}}});
        const R lambda = way[0] + way[1];

        BasicJointStress<R> now;
        now.opening = zero;
        now.normal = curve.stress;
        now.energy = curve.energy;
        now.normal_stiffness = curve.stiffness;
        now.shear = trial - sign * (k * lambda);
        now.strength = curve.stress * friction(n, m.state + lambda);
        now.slid = sign * lambda;
        now.shear_compliance = n[shear_compliance];
        now.heat = slip_heat(step, now, zero);
        now.freed = zero;
        empty_where_open(open, step, zero, now);
        m.state = select(open, m.state, m.state + lambda);
        m.slip += now.slid;
        return now;
    }
};
}  // namespace hdem
