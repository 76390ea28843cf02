#pragma once
/// Force-based law at one contact point.

#include "core/joint/coulomb_slip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
/// Force on the incident block: `normal` pushes it out of the reference block, `shear` acts along t.
template <typename R>
struct BasicPointForce
{
    R normal = 0.0;    ///< F_N >= 0 [N]
    R shear = 0.0;     ///< F_S [N]
    R excess = 0.0;    ///< what slip has taken off the shear force [N]; divided by K_S L, the plastic displacement of this cycle
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

/// Share of a shear force that stays when the contact length becomes `ratio` times what it was: its energy F_S^2 / (2 K_S L) stays. If the whole force stayed, the
/// energy of a corner that turns out of a face would grow without bound.
template <typename R>
[[nodiscard]] inline R shear_share(R ratio)
{
    using std::sqrt;
    return sqrt(ratio);
}

/// dV/dL of the normal springs' energy V, see tilt_force [N]. `work`: sum over both points of F_N times stretch [J], `length_inverse` 2 / L [1/m].
template <typename R>
[[nodiscard]] inline R length_pull(R work, R length_inverse)
{
    return R(0.25) * work * length_inverse;
}

/// Force along the edge that belongs to a point's normal spring, on inc along t [N].
///
/// Both points hold V = sum of 1/2 K_N (L/2) s^2, s their stretches. The normal forces are -dV/ds; but V also changes when inc slides along t:
///
///   f slope    at an end of the reference edge the incident edge passes with its slope ds/dt
///   -+ dV/dL   a vertex of the incident edge takes contact length with it: inwards at the upper end, outwards at the lower (`pull` is given signed)
///
/// Not in the paper, which has one length. Without it V is no potential, and blocks that hit corner first gain energy. Of the order u / L of the normal force:
/// 1e-5 in rock.
/// Where a vertex lies on the reference edge's end, as in flush blocks, V has a kink, and rounding would choose the side: dV/dL begins with 0 there and is
/// whole once the vertex is inside by the overlap.
/// @see verification/unit/core/contact/spring_energy_test.cpp
template <typename R>
[[nodiscard]] inline R tilt_force(R normal, R slope, R pull, R inside, R overlap)
{
    const R tiny = std::numeric_limits<double>::min();
    return select(inside < R(0.0), normal * slope, pull * inside / max(max(inside, overlap), tiny));
}

/// The same of a point that is preloaded by `preload` >= 0 [m]: both parts grow from 0 over that distance. Else, at 10 MPa, N slope would jump by hundreds of newtons
/// where vertices of blocks lie on each other, as in all cut rock, and the blocks would rattle about the kink for ever.
template <typename R>
[[nodiscard]] inline R preloaded_tilt_force(R normal, R slope, R pull, R inside, R overlap, R preload)
{
    const R tiny = std::numeric_limits<double>::min();
    const R outside = max(-inside, R(0.0));
    const R outer = outside / max(max(outside, preload), tiny);
    return select(inside < R(0.0), normal * slope * outer, pull * inside / max(max(inside, max(overlap, preload)), tiny));
}

/// Overlap at which a point's normal spring is empty [m], >= 0.
///
/// 0 for a point that has closed in the force regime. A point handed over from the impulse regime may overlap by more than its last
/// force would press it (impulses do not look at overlaps): a spring that took the whole overlap would release energy that nobody
/// put in, 3.5 kJ for 1 mm at 7e9 Pa/m and 1 m. So the spring begins with the force that remains of the last impulse (remaining_force) at
/// most. The rest is given back to the spring as slowly as the position correction takes old overlap back, so that no block stays sunk:
/// what remains in the end is what the load presses into the springs.
///
///   u_0 = max(0, u - F_rem / (K_N L)) with the last impulse (first_rest_overlap);  u_0 <- max(0, min(u_0 - way, u)) afterwards
///
/// @param way  ContactDef::correction_rate times the size of the smaller block times the step [m]
template <typename R>
[[nodiscard]] inline R rest_overlap(R overlap, R last_rest, R way)
{
    return max(min(last_rest - way, overlap), R(0.0));
}

/// stiffness: K_N L [N/m]
[[nodiscard]] inline double first_rest_overlap(double overlap, double remaining_force, double stiffness)
{
    return overlap > remaining_force / stiffness ? overlap - remaining_force / stiffness : 0.0;
}

/// What remains of an impulse as a force on the contact once the blocks no longer collide [N]:
///
///   F_rem = min(J / dt  a / (a + (1 + R) v), F_last + m_cN a / dt)
///
///   v  approach velocity before the impulse [m/s]     a  load_velocity, what the cycle's forces add to it, and no less than |g| dt [m/s]
///   F_last  the same before this cycle [N]
///
/// An impulse takes two things away: (1 + R) v, the collision, which is over with it, and a, the load, which stays. Exact for a single block.
/// The impulse of a point that others strike also holds their collisions, whatever its own v. So the load grows by no more than the forces of a cycle.
[[nodiscard]] inline double remaining_force(double force, double load_velocity, double restitution, double approach, double most)
{
    const double collision = (1.0 + restitution) * approach;
    return std::min(collision > 0.0 ? force * load_velocity / (load_velocity + collision) : force, most);
}
}  // namespace hdem
