#include "core/detection/carried_history.h"

#include "core/detection/edge_touch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
namespace
{
/// World position of a contact's points relative to the centroid of `from`.
std::array<Vec2, 2> point_positions(const EdgePair& edges, const BlockMotion& ref, const BlockMotion& inc, const BlockMotion& from,
                                    Vec2& direction)
{
    const EdgeView view = view_edges(edges, ref, inc);
    const EdgeTouch touch = touch_edges(edges, view, ref, inc);
    direction = {touch.ex, touch.ey};
    std::array<Vec2, 2> positions;
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint& p = touch.point[k];
        positions[k] = p.ref_t * direction + p.ref_m * turned_left(direction) + Vec2(ref.x - from.x, ref.y - from.y);
    }
    return positions;
}

/// Twice the energy of a point's normal spring at a stretch [J].
double normal_energy(const JointTable& joints, Index law, double length, double stretch)
{
    if (joints.has_memory(law))
        return 2.0 * length * normal_state(joints.rows[law], stretch).energy;
    return joints.laws[law].normal_stiffness * length * stretch * stretch;
}

double stretch_under(const JointTable& joints, Index law, double length, double force)
{
    return joints.has_memory(law) ? closure_under(joints.rows[law], force / length)
                                  : force / (joints.laws[law].normal_stiffness * length);
}
}  // namespace

bool carry_history(const std::vector<BlockMotion>& motion, const Contact& old, Contact& contact)
{
    const BlockMotion& from = motion[contact.ref];
    Vec2 old_direction, direction;
    const auto before = point_positions(old.edges, motion[old.ref], motion[old.inc], from, old_direction);
    const auto after = point_positions(contact.edges, motion[contact.ref], motion[contact.inc], from, direction);
    // Reference and incident block swapped: t flips, and so does the block the force is given on, so its value stays.
    const double sense = old.ref == contact.ref ? 1.0 : -1.0;
    const double along = sense * old_direction.dot(direction);
    contact.point = {};
    // The stress that the rock was drawn with stays on a joint; an edge that meets another one across a corner is a new joint.
    const bool goes_on = along > 0.9 && (old.point[0].regime != Regime::open || old.point[1].regime != Regime::open);
    if (goes_on)
        for (int k = 0; k < 2; ++k)
        {
            const bool first = (after[k] - before[0]).squaredNorm() <= (after[k] - before[1]).squaredNorm();
            contact.point[k].preload = old.point[first ? 0 : 1].preload;
            contact.point[k].memory = old.point[first ? 0 : 1].memory;
            contact.point[k].stiffness = old.point[first ? 0 : 1].stiffness;
        }
    for (int k = 0; k < 2; ++k)
    {
        if (old.point[k].regime == Regime::open)
            continue;
        const int nearest = (before[k] - after[0]).squaredNorm() <= (before[k] - after[1]).squaredNorm() ? 0 : 1;
        PointHistory& point = contact.point[nearest];
        point.normal_force += old.point[k].normal_force;
        point.energy += old.point[k].energy;
        point.shear_force += along > 0.9 ? along * old.point[k].shear_force : 0.0;
        point.tilt_force += along * old.point[k].tilt_force;
        point.rest_overlap = std::max(point.rest_overlap, old.point[k].rest_overlap);
        point.regime = std::max(point.regime, old.point[k].regime);
    }
    return goes_on;
}

void start_points(const std::vector<BlockMotion>& motion, double dt, Contact& contact)
{
    const BlockMotion& ref = motion[contact.ref];
    const BlockMotion& inc = motion[contact.inc];
    const EdgeTouch touch = touch_edges(contact.edges, ref, inc);
    contact.last_length = point_length(touch.length, contact.length_floor);
    for (int k = 0; k < 2; ++k)
        contact.point[k].overlap = touch.point[k].overlap + contact.point[k].preload - touch.point[k].v_m * dt;
}

void limit_energy(const JointTable& joints, const Contact& old, Contact& contact)
{
    const CoulombSlip& old_law = joints.laws[old.law];
    const CoulombSlip& law = joints.laws[contact.law];
    double old_normal = 0.0, old_shear = 0.0, normal = 0.0, shear = 0.0;  // twice the energies [J]
    for (int k = 0; k < 2; ++k)
    {
        if (old.point[k].regime == Regime::impulse)
            return;
        const PointHistory& then = old.point[k];
        const PointHistory& now = contact.point[k];
        const double overlap = std::max(now.overlap + now.memory.opening, 0.0);
        old_normal += normal_energy(joints, old.law, old.last_length,
                                    stretch_under(joints, old.law, old.last_length, then.normal_force));
        old_shear += then.shear_force * then.shear_force / (old_law.shear_stiffness * old.last_length);
        normal += normal_energy(joints, contact.law, contact.last_length, overlap);
        shear += now.shear_force * now.shear_force / (law.shear_stiffness * contact.last_length);
    }
    const double kept = normal > old_normal ? std::sqrt(old_normal / normal) : 1.0;
    const double kept_shear = shear > old_shear ? std::sqrt(old_shear / shear) : 1.0;
    for (PointHistory& point : contact.point)
    {
        point.rest_overlap = std::max(point.overlap + point.memory.opening, 0.0) * (1.0 - kept);
        point.shear_force *= kept_shear;
    }
}
}  // namespace hdem
