#pragma once
/// A contact as observers see it: place, direction and forces. Not used by the cycle itself.

#include "core/model/model.h"
#include "core/state/state.h"

#include <array>
#include <vector>

namespace hdem
{
/// Forces are those of the last cycle, found at the poses at its start; places and overlaps belong to the present poses,
/// one step later.
struct ContactReport
{
    Index first = no_index;  ///< block with the reference edge
    Index second = no_index;
    Vec2 normal = {0.0, 1.0};     ///< from the first to the second block [-]; the shear axis is it turned left
    std::array<Vec2, 2> point;    ///< ends of the contact, in the model's local coordinates [m]
    double length = 0.0;          ///< of the contact [m], >= 0
    double bearing_length = 0.0;  ///< the length the springs act on: at least the contact's floor [m]
    double overlap = 0.0;         ///< greatest of the closed points [m]
    double normal_force = 0.0;    ///< sum over the points, > 0 pushes the second block along the normal [N]
    double shear_force = 0.0;     ///< sum over the points, on the second block along the shear axis [N]
    double tilt_force =
        0.0;  ///< the same of what the slope of the edges and the change of the length add (force_law.h), great at steep corners only [N]
    Regime regime = Regime::open;  ///< the highest of the points'
    int closed_points = 0;
    int impulse_points = 0;
    std::array<JointMemory, 2> memory{};  ///< of laws that have one

    [[nodiscard]] Vec2 shear_axis() const { return turned_left(normal); }
};

/// The shear axis turns with the normal, so shear_force and normal_force do not depend on which block is the first.
[[nodiscard]] ContactReport report_contact(const State& state, Index contact);

/// Have the blocks of a contact with this law met since the start? Then their joint has neither cohesion, tension nor roughness, and nothing to remember.
[[nodiscard]] bool have_met(const JointTable& joints, Index law);

/// 1 where a point is broken, or its blocks have met since the start [-].
[[nodiscard]] double broken_share(const JointTable& joints, Index law, const JointMemory& point);

/// How far a point has lost its roughness or its bond: 0 as drawn, 1 nothing left [-].
[[nodiscard]] double damage_share(const JointTable& joints, Index law, const JointMemory& point);

/// A point of it is closed, and neither block was excavated.
[[nodiscard]] bool is_closed_contact(const State& state, Index contact);

/// Mean stress in a block, compression positive [Pa].
struct MeanStress
{
    double xx = 0.0;
    double yy = 0.0;
    double xy = 0.0;

    /// sqrt(xx^2 + yy^2 + 2 xy^2), the Frobenius norm.
    [[nodiscard]] double magnitude() const;
};

/// Mean stress of every block, in the model's order, from the forces of its contacts and the tractions on its sides:
///
///   sigma = -1/A sum (x_c (x) f_c), made symmetric                  mean of a body in equilibrium
///
///   A area [m2]   x_c from the centroid to the contact point [m]   f_c force on the block there [N]; of a traction the integral over the side
///
/// The minus sign makes compression positive, as rock mechanics has it.
/// @see verification/unit/core/contact/contact_report_test.cpp
[[nodiscard]] std::vector<MeanStress> mean_stresses(const Model& model, const State& state);
}  // namespace hdem
