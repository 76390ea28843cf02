#pragma once
/// Force-based law at one contact point.

#include "core/joint/coulomb_slip.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
/// Force on the incident block: `normal` pushes it out of the reference block, `shear` acts along t.
struct PointForce
{
    double normal = 0.0;     ///< F_N >= 0 [N]
    double shear = 0.0;      ///< F_S [N]
    double slip = 0.0;       ///< plastic shear displacement of this cycle, >= 0 [m]
    double mobilised = 0.0;  ///< |F_S| as a share of the shear strength, 0 to 1; 1 without any strength [-]
    double reserve = 0.0;    ///< shear strength not in use [N]
};

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
[[nodiscard]] inline PointForce spring_force(const CoulombSlip& joint, double length, double overlap, double v_t, double dt,
                                             double last_shear)
{
    PointForce f;
    f.normal = joint.normal_stiffness * length * std::max(overlap, 0.0);
    const double stiffness = joint.shear_stiffness * length;
    const double trial = last_shear - stiffness * v_t * dt;
    const double strength = shear_strength(joint, f.normal, length);
    f.shear = slip_limited(trial, strength);
    f.slip = std::abs(trial - f.shear) / stiffness;
    f.reserve = strength - std::abs(f.shear);
    f.mobilised = strength > 0.0 ? std::abs(f.shear) / strength : 1.0;
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
[[nodiscard]] inline double rest_overlap(bool handed_over, double overlap, double last_rest, double last_normal, double stiffness)
{
    const double rest = handed_over ? overlap - last_normal / stiffness : std::min(last_rest, overlap);
    return std::max(rest, 0.0);
}
}  // namespace hdem
