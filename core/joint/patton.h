#pragma once
/// Patton's bilinear strength: asperities are climbed below a stress and sheared off above it.

#include "core/joint/normal_closure.h"

namespace hdem
{
struct PattonInput
{
    double shear_stiffness = 0.0;      ///< K_S [Pa/m]
    double friction = 0.0;             ///< phi [deg]
    double roughness = 0.0;            ///< i [deg]
    double residual_friction = 0.0;    ///< phi_r [deg]
    double cohesion = 0.0;             ///< c_x [Pa]
    double dilation_limit = no_limit;  ///< slip at which dilation stops [m]
};

/// Patton (1966):
///
///   tau_max = sigma tan(phi + i),  dw = tan i d|u_p|   below sigma_T = c_x / (tan(phi + i) - tan phi_r)
///   tau_max = c_x + sigma tan phi_r,  dw = 0           above
///
/// The return is exact for a linear normal spring; slip that crosses sigma_T is split there. On reversal the opening is given back in
/// proportion to u_p and is 0 where u_p is 0.
///
/// Memory: turn is w / |u_p|; state and broken mean nothing.
/// @pre  tan(phi + i) > tan phi_r; K_N tan(phi + i) tan i < K_S, else the joint snaps back to u_p = 0 on reversal
/// @see  verification/unit/core/joint/patton_test.cpp
struct Patton
{
    enum Number : int
    {
        shear_stiffness = curve_numbers,
        shear_compliance,   ///< 1 / K_S
        friction,           ///< tan(phi + i)
        residual_friction,  ///< tan phi_r
        cohesion,
        change_stress,  ///< sigma_T [Pa]
        dilation,       ///< tan i
        dilation_limit
    };

    [[nodiscard]] static JointNumbers numbers(const PattonInput& in, JointNumbers n)
    {
        n[shear_stiffness] = in.shear_stiffness;
        n[shear_compliance] = compliance_of(in.shear_stiffness);
        n[friction] = tan(radians(in.friction + in.roughness));
        n[residual_friction] = tan(radians(in.residual_friction));
        n[cohesion] = in.cohesion;
        n[dilation] = tan(radians(in.roughness));
        n[dilation_limit] = in.dilation_limit;
        settle(n);
        return n;
    }
    static void settle(JointNumbers& n) { n[change_stress] = n[cohesion] / (n[friction] - n[residual_friction]); }

    template <typename R>
    [[nodiscard]] static R strength(const BasicJointNumbers<R>& n, R normal)
    {
        return min(normal * n[friction], n[cohesion] + normal * n[residual_friction]);
    }

    /// Slip on the way back to u_p = 0 (under a stress above sigma_T, below it), climbing, and level.
    template <typename R>
    [[nodiscard]] static std::array<R, 4> slip(const BasicJointNumbers<R>& n, R excess, R most, R slipped, R turn,
                                               const BasicCurvePoint<R>& p)
    {
        const R zero = 0.0, k = n[shear_stiffness];
        const R back = max(-slipped, zero), fall = p.stiffness * turn, climb = p.stiffness * n[dilation];
        const R above = min(back, select(fall > zero, safe_ratio(max(p.stress - n[change_stress], zero), fall), back));
        const R normal = p.stress - fall * back;
        const R to_limit = max(n[dilation_limit] - max(slipped, zero), zero);
        const R climbing = min(to_limit, select(climb > zero, safe_ratio(max(n[change_stress] - normal, zero), climb), to_limit));
        return slip_along<R, 4>(excess, most,
                                {{{above, k - fall * n[residual_friction]},
                                  {back - above, k - fall * n[friction]},
                                  {climbing, k + climb * n[friction]},
                                  {R(no_limit), k}}});
    }

    [[nodiscard]] static double peak_strength(const JointNumbers& n, double stress) { return strength(n, stress); }
    [[nodiscard]] static double damage_of(const JointNumbers&, const JointMemory& m) { return m.broken; }

    static void weaken(JointNumbers& n, double factor)
    {
        for (const int i : {friction, residual_friction, cohesion})  // sigma_T stays
            n[i] /= factor;
    }
    /// F above which climbing takes more work than friction gives.
    [[nodiscard]] static double greatest_factor(const JointNumbers& n) { return safe_ratio(n[friction], n[dilation]); }
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
        const R w = m.turn * magnitude(m.slip);
        const R trial = step.last_shear - k * step.slide, sign = direction_of(trial);
        const BasicCurvePoint<R> before = Curve::at(n, step.closure + w);
        const auto open = before.stress <= zero;
        const std::array<R, 4> way = slip(n, magnitude(trial) - strength(n, before.stress), safe_ratio(magnitude(trial), k),
                                          sign * m.slip, m.turn, before);
        const R back = way[0] + way[1], lambda = back + (way[2] + way[3]), u = m.slip + sign * lambda;

        BasicJointStress<R> now;
        now.opening = max(w - m.turn * back, zero) + n[dilation] * way[2];
        const BasicCurvePoint<R> after = Curve::at(n, step.closure + now.opening);
        now.normal = max(after.stress, zero);
        now.energy = select(after.stress > zero, after.energy, zero);
        now.normal_stiffness = after.stiffness;
        now.shear = trial - sign * (k * lambda);
        now.strength = strength(n, now.normal);
        now.slid = sign * lambda;
        now.shear_compliance = n[shear_compliance];
        now.heat = slip_heat(step, now, w);
        now.freed = zero;
        empty_where_open(open, step, w, now);
        const auto climbs = way[2] + way[3] > zero;
        m.turn = select(climbs & !open, min(safe_ratio(now.opening, magnitude(u)), n[dilation]), m.turn);
        m.slip = select(open, m.slip, u);
        return now;
    }
};
}  // namespace hdem
