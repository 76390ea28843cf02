#pragma once
/// Coulomb slip of an area with a peak and a residual strength, a tension cut-off and dilation.

#include "core/joint/normal_closure.h"

namespace hdem
{
struct CoulombInput
{
    double shear_stiffness = 0.0;                          ///< K_S [Pa/m]
    double friction_angle = 0.0, residual_friction = 0.0;  ///< phi, phi_r [deg]
    double cohesion = 0.0, residual_cohesion = 0.0;        ///< c, c_r [Pa]
    double tension = 0.0, residual_tension = 0.0;          ///< T, T_r >= 0 [Pa]; T at most c / tan phi
    double dilation_angle = 0.0;                           ///< psi [deg]; at most phi_r, else slip makes energy
    double dilation_limit = no_limit;                      ///< u_lim: slip at which dilation stops [m]
};

/// Area contact of UDEC and 3DEC (Itasca): at any failure c, phi, T fall to c_r, phi_r, T_r at once.
///
///   tau_max = c + sigma tan phi,  sigma >= -T,  w = tan psi min(|u_p|, u_lim)
///
/// The return to the strength is exact for a linear normal spring, also where slip crosses u_p = 0 or the limit:
///
///   d lambda = (|tau| - tau_max) / (K_S + K_N tan phi dw/d lambda),  u_p += +-d lambda
///
/// Dilation is given back on reversal. Residual tension: sigma is held at -T_r; with T_r = 0 an open point carries nothing.
/// Differs from 3DEC's published model: there the strength lags a cycle behind the dilation.
///
/// Memory: broken as named. state: 1 where the joint broke at this place, so that its faces match and dilate; a contact
/// that was not drawn has broken 1 and state 0, and does not dilate.
/// @pre  psi <= phi_r; K_N tan phi tan psi < K_S, else the joint snaps back to u_p = 0 on reversal
/// @see  verification/unit/core/joint/coulomb_residual_test.cpp
struct CoulombResidual
{
    enum Number : int
    {
        shear_stiffness = curve_numbers,
        shear_compliance,  ///< 1 / K_S
        friction,          ///< tan phi
        cohesion,
        tension,
        residual_friction,  ///< tan phi_r
        residual_cohesion,
        residual_tension,
        dilation,  ///< tan psi
        dilation_limit
    };

    [[nodiscard]] static JointNumbers numbers(const CoulombInput& in, JointNumbers n)
    {
        n[shear_stiffness] = in.shear_stiffness;
        n[shear_compliance] = compliance_of(in.shear_stiffness);
        n[friction] = tan(radians(in.friction_angle));
        n[cohesion] = in.cohesion;
        n[tension] = in.tension;
        n[residual_friction] = tan(radians(in.residual_friction));
        n[residual_cohesion] = in.residual_cohesion;
        n[residual_tension] = in.residual_tension;
        n[dilation] = tan(radians(in.dilation_angle));
        n[dilation_limit] = in.dilation_limit;
        return n;
    }

    /// Tension is limited to T_r. The closure stays the variable of the energy, so the joint closes where it opened.
    template <typename R>
    [[nodiscard]] static BasicCurvePoint<R> torn(const BasicJointNumbers<R>& n, R closure, BasicCurvePoint<R> p)
    {
        const R limit = n[residual_tension];
        const auto held = p.stress < -limit;
        const R energy = limit * (-closure) - safe_ratio(R(0.5) * limit * limit, n[curve_stiffness]);
        return {select(held, -limit, p.stress), select(held, R(0.0), p.stiffness), select(held, energy, p.energy)};
    }

    /// Slip along the trial shear stress: back to u_p = 0 first, where the joint has slipped the other way.
    template <typename R>
    [[nodiscard]] static R slip(const BasicJointNumbers<R>& n, R excess, R most, R slipped, R dilation, R coupling)
    {
        const R zero = 0.0, limit = n[dilation_limit], k = n[shear_stiffness];
        const R rise = coupling * dilation;
        const std::array<R, 4> way = slip_along<R, 4>(excess, most,
                                                      {{{max(-limit - slipped, zero), k},
                                                        {max(-max(slipped, -limit), zero), k - rise},
                                                        {max(limit - max(slipped, zero), zero), k + rise},
                                                        {R(no_limit), k}}});
        return (way[0] + way[1]) + (way[2] + way[3]);
    }

    /// tan psi: of a joint that is as drawn, or broke where it was drawn.
    template <typename R>
    [[nodiscard]] static R dilation_now(const BasicJointNumbers<R>& n, const BasicJointMemory<R>& m)
    {
        const R half = 0.5;
        return select((m.broken < half) | (m.state > half), n[dilation], R(0.0));
    }

    /// w
    template <typename R>
    [[nodiscard]] static R opening(const BasicJointNumbers<R>& n, const BasicJointMemory<R>& m)
    {
        return dilation_now(n, m) * min(magnitude(m.slip), n[dilation_limit]);
    }

    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress)
    {
        return max(n[cohesion] + stress * n[friction], 0.0);
    }
    [[nodiscard]] static double damage_of(const JointNumbers&, const JointMemory& m) { return m.broken; }

    static void weaken(JointNumbers& n, double factor)
    {
        for (const int i : {friction, cohesion, tension, residual_friction, residual_cohesion, residual_tension})
            n[i] /= factor;
    }
    static void keep_peak(JointNumbers& n)
    {
        n[residual_friction] = n[friction];
        n[residual_cohesion] = n[cohesion];
        n[residual_tension] = n[tension];
    }
    [[nodiscard]] static bool loses_strength(const JointNumbers& n)
    {
        return n[residual_friction] < n[friction] || n[residual_cohesion] < n[cohesion] || n[residual_tension] < n[tension];
    }
    /// F above which dilation takes more work than residual friction gives.
    [[nodiscard]] static double greatest_factor(const JointNumbers& n) { return safe_ratio(n[residual_friction], n[dilation]); }
    static void stiffen(JointNumbers& n, double times)
    {
        n[shear_stiffness] *= times;
        n[shear_compliance] /= times;
    }

    template <typename Curve, typename R>
    [[nodiscard]] static BasicJointStress<R> react(const BasicJointNumbers<R>& n, const BasicJointStep<R>& step,
                                                   BasicJointMemory<R>& m)
    {
        const R zero = 0.0, one = 1.0, half = 0.5, k = n[shear_stiffness], limit = n[dilation_limit];
        const auto intact = m.broken < half;
        const R d = dilation_now(n, m);
        const R w = d * min(magnitude(m.slip), limit);
        const R trial = step.last_shear - k * step.slide, sign = direction_of(trial);

        const R closure = step.closure + w;
        const BasicCurvePoint<R> whole = Curve::at(n, closure);
        const R peak = max(n[cohesion] + n[friction] * whole.stress, zero);
        const auto pulled = whole.stress < -n[tension];
        const auto sheared = magnitude(trial) > peak;
        const auto breaks = intact & (pulled | sheared);
        const auto weak = breaks | !intact;
        const BasicCurvePoint<R> rest = torn(n, closure, whole);
        const R mu = select(weak, n[residual_friction], n[friction]), c = select(weak, n[residual_cohesion], n[cohesion]);
        const auto open = weak & (rest.stress <= zero) & (n[residual_tension] <= zero);

        const R normal = select(weak, rest.stress, whole.stress);
        const R coupling = mu * select(weak, rest.stiffness, whole.stiffness);
        const R excess = magnitude(trial) - max(c + mu * normal, zero);
        R lambda = zero;
        if (any(excess > zero))  // most points of most cycles stick
            lambda = slip(n, excess, safe_ratio(magnitude(trial), k), sign * m.slip, d, coupling);
        const R slipped = m.slip + sign * lambda;

        BasicJointStress<R> now;
        now.opening = d * min(magnitude(slipped), limit);
        BasicCurvePoint<R> end_whole = whole, end_torn = rest;
        if (any(!(now.opening == w)))
        {
            end_whole = Curve::at(n, step.closure + now.opening);
            end_torn = torn(n, step.closure + now.opening, end_whole);
        }
        now.normal = select(weak, end_torn.stress, end_whole.stress);
        now.energy = select(weak, end_torn.energy, end_whole.energy);
        now.normal_stiffness = select(weak, end_torn.stiffness, end_whole.stiffness);
        now.shear = trial - sign * (k * lambda);
        now.strength = max(c + mu * now.normal, zero);
        now.slid = sign * lambda;
        now.shear_compliance = n[shear_compliance];
        const R dropped = select(
            breaks,
            max(shear_energy(min(magnitude(trial), peak), now.shear_compliance) - shear_energy(now.shear, now.shear_compliance),
                zero),
            zero);
        now.heat = slip_heat(step, now, w) - dropped;
        now.freed = dropped;
        empty_where_open(open, step, w, now);
        now.freed += select(breaks, whole.energy - rest.energy, zero);

        m.slip = select(open, m.slip, slipped);
        m.state = select(breaks, one, m.state);
        m.broken = select(breaks, one, m.broken);
        return now;
    }
};
}  // namespace hdem
