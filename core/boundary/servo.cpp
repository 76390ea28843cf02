#include "core/boundary/servo.h"

#include "core/boundary/side_forces.h"
#include "core/contact/block_forces.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double gain = 0.05;    // of the missing force in a cycle
constexpr double enough = 1e-3;  // of the target

template <typename Action>
void for_servos(const Model& model, const State& state, const Action& action)
{
    for (const Boundary& boundary : model.boundaries)
        if (boundary.kind == BoundaryKind::servo && boundary.acts(state.stage))
            for (const BoundaryWall& wall : boundary.walls)
                action(boundary, wall);
}
}  // namespace

WallForce wall_force(Index wall, const Model& model, const Contacts& contacts, const BlockContacts& list)
{
    WallForce sum;
    for (Index e = list.begin[wall]; e < list.begin[wall + 1]; ++e)
    {
        const Contact contact = contacts.get(list.entry[e] / 2);
        for (const PointHistory& point : contact.point)
            if (point.regime != Regime::open)
            {
                sum.normal += point.normal_force;
                sum.stiffness += model.joints.laws[contact.law].normal_stiffness * contact.last_length;
            }
    }
    return sum;
}

double pressed_length(const Boundary& boundary, const BoundaryWall& wall, const Blocks& blocks)
{
    const Vec2 n = wall.inward();
    double length = wall.length;
    for (const BoundaryFace& face : boundary.faces)
    {
        const BlockInertia& inertia = blocks.inertia[face.block];
        const bool moves = inertia.inverse_mass_x * std::abs(n.x()) + inertia.inverse_mass_y * std::abs(n.y()) > 0.0;
        if (!moves && blocks.present[face.block] != 0 && wall.is_behind(face))
            length -= (face.to - face.from).norm();
    }
    return std::max(length, 0.0);
}

double servo_velocity(const WallForce& force, double target, double max_velocity, double step)
{
    if (force.stiffness <= 0.0)
        return max_velocity;
    return std::clamp(gain * (target - force.normal) / (force.stiffness * step), -max_velocity, max_velocity);
}

void drive_walls(const Model& model, const BlockContacts& list, State& state)
{
    for (const Boundary& boundary : model.boundaries)
    {
        if (boundary.kind != BoundaryKind::velocity || !boundary.factor.varies() || !boundary.acts(state.stage))
            continue;
        const Vec2 velocity = factor_of(boundary, model, state) * boundary.velocity;
        for (const BoundaryWall& wall : boundary.walls)
        {
            state.blocks.motion[wall.block].vx = velocity.x();
            state.blocks.motion[wall.block].vy = velocity.y();
        }
    }
    for_servos(model, state,
               [&](const Boundary& boundary, const BoundaryWall& wall)
               {
                   const WallForce force = wall_force(wall.block, model, state.contacts, list);
                   const double target = factor_of(boundary, model, state) * boundary.target *
                                         pressed_length(boundary, wall, state.blocks);
                   const Vec2 velocity = servo_velocity(force, target, boundary.max_velocity, state.blocks.step.next) *
                                         wall.inward();
                   state.blocks.motion[wall.block].vx = velocity.x();
                   state.blocks.motion[wall.block].vy = velocity.y();
               });
}

bool servos_press(const Model& model, const State& state)
{
    bool all = true;
    BlockContacts list;
    for_servos(model, state,
               [&](const Boundary& boundary, const BoundaryWall& wall)
               {
                   if (list.begin.empty())
                       list_block_contacts(state.contacts, state.blocks.size(), list);
                   const double whole = boundary.target * pressed_length(boundary, wall, state.blocks),
                                target = factor_of(boundary, model, state) * whole;
                   all = all && std::abs(wall_force(wall.block, model, state.contacts, list).normal - target) <= enough * whole;
               });
    return all;
}
}  // namespace hdem
