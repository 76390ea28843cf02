#pragma once
/// Force-based law at one contact point.

#include "core/joint/coulomb_slip.h"

namespace hdem
{
/// Force on the incident block: `normal` pushes it out of the reference block, `shear` acts along t.
template <typename R>
struct BasicPointForce
{
    R normal = 0.0;    ///< F_N >= 0 [N]
    R shear = 0.0;     ///< F_S [N]
    R excess = 0.0;    ///< what slip has taken off the shear force; over K_S L it is the plastic displacement of this cycle [N]
    R strength = 0.0;  ///< shear strength F_max [N]
};
using PointForce = BasicPointForce<double>;

/// Linear normal and shear springs, limited by Coulomb slip.
///
///   F_N = K_N L u_N                                                 [Lee2025] Eq. (5), in total form
///   F_S <- F_S - K_S L v_t dt,  |F_S| <= F_N tan(phi) + c L         [Lee2025] Eqs. (2), (6), (9), (10)
///
///   u_N overlap beyond the rest overlap (usually 0, see rest_overlap) [m]   v_t velocity of inc relative to ref along t, amid the last step [m/s]   dt [s]
///   L   the point's share of the contact length [m], so that K [Pa/m] times L is a stiffness per unit thickness [N/m]
///
/// Differs from the paper: F_N is total, not incremental (no drift); a gap carries no tension; K and c act on L, where
/// the paper's test has L = 1 m. Two points at the ends of a face of length L give it the rotational stiffness k L^2 / 4,
/// three times that of a continuous joint.
/// @pre  length > 0
/// @see  verification/unit/core/contact/force_law_test.cpp
template <typename R>
[[nodiscard]] inline BasicPointForce<R> spring_force(const BasicCoulombSlip<R>& joint, R length, R overlap, R v_t, R dt,
                                                     R last_shear)
{
    BasicPointForce<R> f;
    f.normal = joint.normal_stiffness * length * max(overlap, R(0.0));
    const R stiffness = joint.shear_stiffness * length;
    const R trial = last_shear - stiffness * v_t * dt;
    f.strength = shear_strength(joint, f.normal, length);
    f.shear = slip_limited(trial, f.strength);
    f.excess = trial - f.shear;
    return f;
}

/// Overlap at which a point's normal spring is empty [m], >= 0.
///
/// 0 for a point that has closed in the force regime. A point handed over from the impulse regime may overlap by more than its last
/// force would press it (impulses do not look at overlaps): a spring that took the whole overlap would release energy that nobody
/// put in, 3.5 kJ for 1 mm at 7e9 Pa/m and 1 m. So the spring begins with that force at most, and the rest stays until the blocks
/// move apart.
///
///   u_0 = max(0, u - F / (K_N L)) at the hand-over;  u_0 <- min(u_0, u) afterwards
///
///   compliance  1 / (K_N L) [m/N]
template <typename R, typename M>
[[nodiscard]] inline R rest_overlap(M handed_over, R overlap, R last_rest, R last_normal, R compliance)
{
    return max(select(handed_over, overlap - last_normal * compliance, min(last_rest, overlap)), R(0.0));
}
}  // namespace hdem
