#pragma once
/// Force or impulse: which law a contact point obeys in this cycle.

#include "core/state/blocks.h"

#include <cmath>

namespace hdem
{
/// Which normal springs give only a share of their force in the cycles in which they close or open (contact/closing.h).
enum class Closing
{
    /// None, as in the paper.
    whole_cycles,
    /// Contacts with a point that moves in two cycles by more than its overlap. These are all that matter where springs take many cycles to reverse a motion.
    fast_points,
    /// All: where springs reverse a motion within few cycles.
    all_points
};

/// Which law contact points obey.
enum class ContactLaw
{
    springs,
    impulses,
    by_speed  ///< impulses above the threshold velocity, Eq. (24)
};

/// Who chooses the law of a contact point.
struct RegimeRule
{
    ContactLaw law = ContactLaw::by_speed;
    /// In a stage that looks for a state of rest the standing rock, blocks that have not come loose (see core/motion/step_control.h), answers impacts with its
    /// springs, unless they are slower than `gentle_impact` sqrt(g size of the loose block). Differs from the paper: an impulse hands all of a block's
    /// momentum to the rock at once and undamped, where springs let local damping and the rock behind take their part. So a tunnel in which blocks fall on
    /// standing rock moves as by springs alone.
    bool rock_keeps_springs = false;
    /// A corner on a corner, of blocks that lie where they were (`drawn_share`), keeps its springs. Differs from the paper: such a contact has next to no
    /// length. It stores nothing, and its threshold is 0. An impulse there would be a rigid prop in rock that gives way elastically beside it, and
    /// rock around a hole would move too little.
    bool corners_keep_springs = false;
    /// A point that has borne an impulse stays closed while it is open by less than blocks fall in a cycle: its blocks may close that way, and no more. Differs
    /// from the paper: where the correction of one corner lifts the other one of a face, the block would hop from corner to corner for ever.
    bool lifted_stay_closed = false;
    Closing closing = Closing::fast_points;
    double closing_speed =
        0.0;  ///< slower contacts give whole forces in each cycle [m/s]; else rock would take a third more time to come to rest
};

inline constexpr double gentle_impact = 0.1;

/// A block that has moved by less than this share of its size in its stage lies where it was [-].
inline constexpr double drawn_share = 0.01;

/// Inverse collision mass of a contact point along one axis, [Lee2025] Eq. (16), (A.15), (A.20) [1/kg]:
///
///   1/m_c = 1/m_A + |u_A x n|^2 / I_A + 1/m_B + |u_B x n|^2 / I_B
///
///   n     unit vector (n_x, n_y) [-]      lever_*  u x n of each block [m]
///
/// A block whose motion is prescribed counts as infinitely heavy in that component.
template <typename R>
[[nodiscard]] inline R inverse_collision_mass(const BasicInertia<R>& a, R lever_a, const BasicInertia<R>& b, R lever_b, R n_x,
                                              R n_y)
{
    return (a.inverse_mass_x + b.inverse_mass_x) * n_x * n_x + (a.inverse_mass_y + b.inverse_mass_y) * n_y * n_y +
           a.inverse_inertia * lever_a * lever_a + b.inverse_inertia * lever_b * lever_b;
}

/// Elastic part of the threshold velocity that one contact point contributes, squared [m2/s2]:
///
///   K_N u_N^2 / m_cN + K_S u_S^2 / m_cS                              [Lee2025] Eq. (27), (A.22)
///
///   u_N = F_N / (K_N L), u_S = F_S / (K_S L)   deflections *stored in the springs* in the last cycle [m]
///   normal_stiffness, shear_stiffness          K_N L, K_S L of the point [N/m]
///
/// A contact stores the energy of its two points; their contributions add up.
///
/// Differs from the paper's wording: u_N is not the geometric overlap. A first touch has stored nothing, and with the
/// overlap v dt in its place u_elastic grows with the impact speed itself, so that no impact would count as one.
/// In terms of forces K u^2 = F^2 / K.
template <typename R>
[[nodiscard]] inline R elastic_velocity_squared(R last_normal, R normal_stiffness, R inverse_mass_normal, R last_shear,
                                                R shear_stiffness, R inverse_mass_shear)
{
    return last_normal * last_normal / normal_stiffness * inverse_mass_normal +
           last_shear * last_shear / shear_stiffness * inverse_mass_shear;
}

/// Threshold velocity of a contact: above it the impulse law holds [m/s].
///
///   u_th = C_scale (dt |g| + u_elastic)                              [Lee2025] Eqs. (25), (26)
template <typename R>
[[nodiscard]] inline R threshold_velocity(R scale, R gravity_velocity, R elastic_squared)
{
    using std::sqrt;
    return scale * (gravity_velocity + sqrt(elastic_squared));
}
}  // namespace hdem
