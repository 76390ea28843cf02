#pragma once
/// Coulomb slip: the strength of a rock joint.

#include <algorithm>
#include <cmath>

namespace hdem
{
/// A joint's properties as the laws use them.
struct CoulombSlip
{
    double normal_stiffness = 0.0;      ///< K_N [Pa/m]
    double shear_stiffness = 0.0;       ///< K_S [Pa/m]
    double friction_coefficient = 0.0;  ///< tan phi [-]
    double cohesion = 0.0;              ///< c [Pa]
    double restitution = 0.0;           ///< R of Eq. (15) [-], used by the impulse law only
};

/// Greatest shear force a contact point can carry [N]:
///
///   F_max = F_N tan(phi) + c L                                      [Lee2025] Eq. (10)
///
///   F_N normal force, >= 0 [N]   L this point's share of the contact length [m], unit thickness
///
/// Differs from the paper: c [Pa] acts on L; the paper's test has L = 1 m and adds c as if it were a force.
/// @see verification/unit/core/joint/coulomb_slip_test.cpp
[[nodiscard]] inline double shear_strength(const CoulombSlip& joint, double normal_force, double length)
{
    return normal_force * joint.friction_coefficient + joint.cohesion * length;
}

/// Shear force cut back to what the joint can carry, with its sign kept; [Lee2025] Eq. (9).
[[nodiscard]] inline double slip_limited(double shear_force, double strength)
{
    return std::clamp(shear_force, -strength, strength);
}
}  // namespace hdem
