#pragma once
/// Effect of an impulse at a contact point on the velocities of its blocks, and their relative velocity at the point.

#include "core/state/blocks.h"
#include "core/state/workspace.h"

#include <algorithm>

namespace hdem
{
/// Velocity of inc relative to ref at the point: along t, and along m (approaching > 0).
struct PointVelocity
{
    double t, m;
};

template <typename A, typename B>
[[nodiscard]] inline PointVelocity relative_velocity(const ImpulsePoint& p, double dvx, double dvy, const A& ref, const B& inc)
{
    return {p.t_x * dvx + p.t_y * dvy - inc.w * p.inc_m + ref.w * p.ref_m,
            p.t_x * dvy - p.t_y * dvx + inc.w * p.inc_t - ref.w * p.ref_t};
}

[[nodiscard]] inline PointVelocity relative_velocity(const ImpulsePoint& p, const BlockMotion& ref, const BlockMotion& inc)
{
    return relative_velocity(p, inc.vx - ref.vx, inc.vy - ref.vy, ref, inc);
}

/// Greatest shear impulse that a point can bear [N s].
[[nodiscard]] inline double shear_limit(const ImpulsePoint& point, double normal)
{
    return std::max(normal * point.friction + point.cohesive_impulse, 0.0);
}

/// Impulse (j_t, j_m) on inc and its opposite on ref, Eqs. (17), (18).
struct Kick
{
    double x, y, w_ref, w_inc;

    Kick(const ImpulsePoint& p, double j_t, double j_m)
        : x(p.t_x * j_t - p.t_y * j_m),
          y(p.t_y * j_t + p.t_x * j_m),
          w_ref(p.ref_t * j_m - p.ref_m * j_t),
          w_inc(p.inc_t * j_m - p.inc_m * j_t)
    {
    }
};

/// Apply a kick to one block. A block that cannot move is not written to at all: parts of one colour may share it.
inline void change_velocity(const BlockInertia& inertia, double x, double y, double moment, double& vx, double& vy, double& w)
{
    if (!can_move(inertia))
        return;
    vx += inertia.inverse_mass_x * x;
    vy += inertia.inverse_mass_y * y;
    w += inertia.inverse_inertia * moment;
}

/// Impulse (j_t, j_m) on inc and its opposite on ref.
/// @return energy that it takes: its work with the mean of the velocities before and after it [J]
inline double push(const ImpulsePoint& p, double j_t, double j_m, Blocks& blocks)
{
    BlockMotion& ref = blocks.motion[p.ref];
    BlockMotion& inc = blocks.motion[p.inc];
    const PointVelocity before = relative_velocity(p, ref, inc);
    const Kick kick(p, j_t, j_m);
    change_velocity(blocks.inertia[p.ref], -kick.x, -kick.y, -kick.w_ref, ref.vx, ref.vy, ref.w);
    change_velocity(blocks.inertia[p.inc], kick.x, kick.y, kick.w_inc, inc.vx, inc.vy, inc.w);
    const PointVelocity after = relative_velocity(p, ref, inc);
    return -0.5 * (j_t * (before.t + after.t) + j_m * (before.m + after.m));
}
}  // namespace hdem
