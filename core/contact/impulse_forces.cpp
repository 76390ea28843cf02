#include "core/contact/impulse_forces.h"

#include "core/contact/force_law.h"
#include "core/contact/impulse_kick.h"
#include "core/joint/all_laws.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
void add_impulse_work(const Model& model, const std::vector<ImpulsePoint>& points, const Blocks& blocks, EnergyLedger& ledger)
{
    const double half_step = 0.5 * blocks.step.next;
    const auto book = [&](Index block, double x, double y, double w)
    {
        const BlockInertia& inertia = blocks.inertia[block];
        const BlockForce& force = blocks.force[block];
        const Vec2 weight = model.mass[block] * model.gravity;
        const double dvx = inertia.inverse_mass_x * x;
        const double dvy = inertia.inverse_mass_y * y;
        const BlockMotion& motion = blocks.motion[block];  // what holds a prescribed motion takes the impulse too
        const double holding = (inertia.inverse_mass_x > 0.0 ? 0.0 : x * motion.vx) +
                               (inertia.inverse_mass_y > 0.0 ? 0.0 : y * motion.vy) +
                               (inertia.inverse_inertia > 0.0 ? 0.0 : w * motion.w);
        (model.is_wall(block) ? ledger.boundary : ledger.load_work) -= holding;
        ledger.gravity_work += half_step * (weight.x() * dvx + weight.y() * dvy);
        const double dw = inertia.inverse_inertia * w;
        ledger.impulse_loss += half_step * (force.x * dvx + force.y * dvy + force.moment * dw);
        ledger.coasting += half_step * ((force.x - weight.x()) * dvx + (force.y - weight.y()) * dvy + force.moment * dw);
    };
    for (const ImpulsePoint& p : points)
    {
        const Kick kick(p, p.impulse_shear, -p.impulse_normal);
        book(p.ref, -kick.x, -kick.y, -kick.w_ref);
        book(p.inc, kick.x, kick.y, kick.w_inc);
    }
}

namespace
{
bool can_break(const JointRow& row)
{
    return row.is_bonded || row.kind == kind_of<CoulombResidual>();
}

/// Does the point move at its strength, along the joint or away from it? Impulses know no stiffness: they may load one point of a joint up to its strength and another one
/// hardly. Such a point holds what it bears, and gives way only where the others cannot hold the rest.
bool gives_way(const ImpulsePoint& p, const Blocks& blocks)
{
    constexpr double nearly = 1.0 - 1e-12;
    constexpr double noticeable = 0.03;  // of the velocity that the impulse at its strength gives: more than sweeps leave
    const PointVelocity v = relative_velocity(p, blocks.motion[p.ref], blocks.motion[p.inc]);
    const bool is_pulled = p.pull > 0.0 && p.impulse_normal <= -nearly * p.pull;
    if (is_pulled && -v.m * p.mass_normal > noticeable * p.pull)
        return true;
    const double limit = shear_limit(p, p.impulse_normal);
    return std::abs(p.impulse_shear) >= nearly * limit && std::abs(v.t) * p.mass_shear > noticeable * limit;
}

/// A joint whose strength is overcome breaks.
void break_at_strength(const Model& model, const Blocks& blocks, const ImpulsePoint& p, Contacts& contacts)
{
    const Index law = contacts.law[p.contact];
    if (!model.joints.has_memory(law) || !can_break(model.joints.rows[law]) || !gives_way(p, blocks))
        return;
    MemoryLanes::Point& memory = contacts.memory_lane[p.contact / lanes].point[p.end];
    if (memory.broken[p.contact % lanes] < 0.5)
        memory.broken[p.contact % lanes] = memory.state[p.contact % lanes] = 1.0;
}
}  // namespace

void store_impulses(const Model& model, const Blocks& blocks, const std::vector<ImpulsePoint>& points, Contacts& contacts)
{
    const double dt = blocks.step.kick();
    for (const ImpulsePoint& p : points)
    {
        break_at_strength(model, blocks, p, contacts);
        contacts.normal_force(p.end, p.contact) = p.impulse_normal / dt;
        contacts.shear_force(p.end, p.contact) = p.impulse_shear / dt;
        const double kept = remaining_force(std::max(p.impulse_normal, 0.0) / dt, p.load_velocity, p.restitution, p.approach,
                                            p.spring_force + p.mass_normal * p.load_velocity / dt);
        contacts.rest_overlap(p.end, p.contact) = first_rest_overlap(p.pressed, kept, p.stiffness);
    }
}

void add_impulse_forces(const std::vector<ImpulsePoint>& points, Blocks& blocks)
{
    const double dt = blocks.step.kick();
    std::vector<BlockForce>& force = blocks.force;
    for (const ImpulsePoint& p : points)
    {
        const Kick kick(p, p.impulse_shear / dt, -p.impulse_normal / dt);
        force[p.ref].x -= kick.x;
        force[p.ref].y -= kick.y;
        force[p.ref].moment -= kick.w_ref;
        force[p.inc].x += kick.x;
        force[p.inc].y += kick.y;
        force[p.inc].moment += kick.w_inc;
    }
}
}  // namespace hdem
