#pragma once
/// The springs of a contact as rows of a stiffness matrix.

#include "core/detection/edge_touch.h"
#include "core/model/model.h"
#include "core/state/contacts.h"

#include <Eigen/Core>

#include <algorithm>

namespace hdem
{
/// Motion or force of a block as (x, y, rotation).
using Vec3 = Eigen::Vector3d;

/// One of the two springs of a contact point, as if it was closed and stuck.
struct ContactSpring
{
    double stiffness;  ///< K L of the point [N/m]
    Vec3 ref, inc;     ///< derivative of its stretch by the motion of ref, of inc [-, -, m]
};

/// K_N of a point: of a law with a memory no less than at the last forces [Pa/m].
[[nodiscard]] inline double present_stiffness(const Model& model, const Contacts& contacts, Index contact, int k)
{
    const double least = model.joints.laws[contacts.law[contact]].normal_stiffness;
    return contacts.has_memory ? std::max(least, contacts.memory_lane[contact / lanes].point[k].stiffness[contact % lanes]) : least;
}

/// Call `use(touch, k, normal, shear)` for both points of a contact.
template <typename Use>
void for_springs(const Model& model, const Blocks& blocks, const Contacts& contacts, Index contact, const Use& use)
{
    const BlockMotion& ref = blocks.motion[contacts.ref[contact]];
    const BlockMotion& inc = blocks.motion[contacts.inc[contact]];
    const EdgeTouch touch = touch_edges(contacts.edges(contact), ref, inc);
    const CoulombSlip& joint = model.joints.laws[contacts.law[contact]];
    const double length = point_length(touch.length, contacts.length_floor(contact));
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint& p = touch.point[k];
        use(touch, k,
            ContactSpring{present_stiffness(model, contacts, contact, k) * length, Vec3(-touch.ey, touch.ex, p.ref_t),
                          Vec3(-touch.ey, touch.ex, p.inc_t)},
            ContactSpring{joint.shear_stiffness * length, Vec3(touch.ex, touch.ey, -p.ref_m), Vec3(touch.ex, touch.ey, -p.inc_m)});
    }
}

/// Inverse masses of a block; none where its motion is prescribed.
[[nodiscard]] inline Vec3 inverse_masses(const Blocks& blocks, Index block)
{
    const BlockInertia& inertia = blocks.inertia[block];
    return {inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_inertia};
}
}  // namespace hdem
