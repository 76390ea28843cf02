#pragma once
/// Force law at one contact point for a static solution: what it bears at given places of the blocks, and how that changes with them.

#include "core/contact/force_law.h"

#include <array>
#include <cstdint>

namespace hdem
{
enum class PointStatus : std::uint8_t
{
    open,   ///< bears no normal force
    stick,  ///< closed, below its shear strength
    slip    ///< closed, at its shear strength
};

/// Where a point stands, seen from the last equilibrium.
struct PointPlace
{
    double length = 0.0;   ///< its share of the contact length [m]
    double stretch = 0.0;  ///< overlap beyond the rest overlap [m]
    double way = 0.0;      ///< of inc along the reference edge since the last equilibrium [m]
    bool is_closed = false;
    bool bears = true;  ///< false: neither closed nor held by cohesion
};

/// What a point gives there.
struct PointReaction
{
    double normal = 0.0;    ///< F_N >= 0 [N]
    double shear = 0.0;     ///< F_S, on inc along t [N]
    double strength = 0.0;  ///< shear strength [N]
    double excess = 0.0;    ///< what slip has taken off the shear force [N]
    PointStatus status = PointStatus::open;
};

/// The law of spring_force over a whole increment of load in place of a cycle:
///
///   F_N = K_N L max(u, 0),   F_S = clip(T - K_S L s, F_N tan(phi) + c L)
///
///   u stretch, s way since the last equilibrium [m]    T shear force then [N]
///
/// A point that opens keeps its cohesion c L until the solution has come to rest without it: a force that vanishes as soon as a point opens makes
/// Newton's iteration jump from state to state.
/// @param frozen_strength  >= 0: shear strength that does not follow the normal force, as the energy along a step needs [N]
/// @see  verification/unit/core/statics/point_law_test.cpp
[[nodiscard]] inline PointReaction react(const CoulombSlip& joint, const PointPlace& at, double start_shear,
                                         double frozen_strength = -1.0)
{
    if (!at.bears)
        return {};
    const PointForce f = spring_force(joint, at.length, at.stretch, at.way, 1.0, start_shear);
    PointReaction r{f.normal, f.shear, f.strength, f.excess, PointStatus::open};
    if (frozen_strength >= 0.0)
    {
        r.shear = slip_limited(f.shear + f.excess, frozen_strength);
        r.excess += f.shear - r.shear;
    }
    if (at.is_closed)
        r.status = r.excess == 0.0 ? PointStatus::stick : PointStatus::slip;
    return r;
}

/// Derivatives of a point's forces [N/m].
struct PointTangent
{
    double normal = 0.0;    ///< dF_N / du
    double shear = 0.0;     ///< -dF_S / ds
    double coupling = 0.0;  ///< dF_S / du: a slipping point's strength follows its normal force
};

/// `trust`: share of the elastic stiffness that stands in for a derivative that is zero, see static_contacts.h [-].
[[nodiscard]] inline PointTangent tangent(const CoulombSlip& joint, double length, const PointReaction& r, bool bears, double trust)
{
    const double normal = joint.normal_stiffness * length;
    const double shear = joint.shear_stiffness * length;
    if (r.status == PointStatus::open)
        return {trust * normal, bears && r.excess == 0.0 ? shear : trust * shear, 0.0};
    if (r.status == PointStatus::stick)
        return {normal, shear, 0.0};
    return {normal, trust * shear, (r.excess < 0.0 ? -1.0 : 1.0) * joint.friction_coefficient * normal};
}
}  // namespace hdem
