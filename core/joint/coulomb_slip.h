#pragma once
/// Coulomb slip: the strength of a rock joint.

#include "core/simd.h"

#include <cmath>

namespace hdem
{
/// A joint's properties as the laws use them; R: double, or Pack for four joints.
template <typename R>
struct BasicCoulombSlip
{
    R normal_stiffness = 0.0;      ///< K_N [Pa/m]
    R shear_stiffness = 0.0;       ///< K_S [Pa/m]
    R friction_coefficient = 0.0;  ///< tan phi [-]
    R cohesion = 0.0;              ///< c [Pa]
    R restitution = 0.0;           ///< R of Eq. (15) [-], used by the impulse law only
};
using CoulombSlip = BasicCoulombSlip<double>;

/// Greatest shear force a contact point can carry [N]:
///
///   F_max = F_N tan(phi) + c L                                      [Lee2025] Eq. (10)
///
///   F_N normal force, >= 0 [N]   L this point's share of the contact length [m], unit thickness
///
/// Differs from the paper: c [Pa] acts on L; the paper's test has L = 1 m and adds c as if it were a force.
/// @see verification/unit/core/joint/coulomb_slip_test.cpp
template <typename R>
[[nodiscard]] inline R shear_strength(const BasicCoulombSlip<R>& joint, R normal_force, R length)
{
    return normal_force * joint.friction_coefficient + joint.cohesion * length;
}

/// Shear force cut back to what the joint can carry, with its sign kept; [Lee2025] Eq. (9).
template <typename R>
[[nodiscard]] inline R slip_limited(R shear_force, R strength)
{
    return min(max(shear_force, -strength), strength);
}
}  // namespace hdem
