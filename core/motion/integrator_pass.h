#pragma once
/// One pass over blocks, as many at a time as a pack P holds: new velocities, new poses.

#include "core/motion/block_lanes.h"
#include "core/motion/integrator.h"
#include "core/motion/rest.h"

#include <bit>

namespace hdem
{
inline namespace HDEM_LANES
{
/// Stopped blocks do not move, whatever acts on them.
template <typename P>
inline void hold_stopped(const std::uint8_t* rest, Index count, BasicInertia<P>& inertia)
{
    static_assert(std::has_single_bit(stopped));
    unsigned bits = 0;
    for (Index k = 0; k < count; ++k)
        bits |= rest[k];
    if (bits < stopped)
        return;
    for (Index k = 0; k < count; ++k)
        if (rest[k] >= stopped)
            inertia.inverse_mass_x.v[k] = inertia.inverse_mass_y.v[k] = inertia.inverse_inertia.v[k] = 0.0;
}

/// VelocityWorks while they are formed.
struct WorkLanes
{
    Pack gravity, holding, local, global, changes, coasting;

    explicit WorkLanes(const VelocityWorks& of)
        : gravity(of.gravity),
          holding(of.holding),
          local(of.local),
          global(of.global),
          changes(of.changes),
          coasting(of.coasting)
    {
    }
    [[nodiscard]] VelocityWorks stored() const
    {
        return {gravity.lane_sums(), holding.lane_sums(), local.lane_sums(),
                global.lane_sums(),  changes.lane_sums(), coasting.lane_sums()};
    }
};

/// One component of the motion of a pack of blocks over one step.
template <typename P>
struct Component
{
    P velocity, force;                                          ///< net, before damping
    P damped;                                                   ///< after local damping
    P inverse;                                                  ///< inverse mass or inertia, 0 where the motion is prescribed
    P next = 0.0;                                               ///< new velocity
    P holding = 0.0, local = 0.0, global = 0.0, changes = 0.0;  ///< works
};

/// New velocity and works of a component. The kinetic energy changes by each force times the mean of both velocities and the mean of both steps;
/// springs, weight and loads are booked by the mean of both ways, (v last + v' next) / 2. Where the step changes the first is F (v' - v) (next - last) / 4 less.
template <bool step_changes, typename P>
inline void advance(Component<P>& c, P global, bool has_global, const Steps& step)
{
    const P zero = 0.0;
    const P dt = step.kick();
    const MaskOf<P> is_free = c.inverse > zero;
    const P kept = has_global ? select(is_free, c.velocity * (P(1.0) - global * dt), c.velocity) : c.velocity;
    c.next = kept + c.damped * c.inverse * dt;
    const P way = P(0.5) * (c.velocity + c.next) * dt;
    c.holding = select(is_free, zero, c.force * way);  // what holds a prescribed motion
    c.local = select(is_free, (c.force - c.damped) * way, zero);
    if (has_global)
        c.global = select(is_free, global * c.velocity / c.inverse * way, zero);
    if constexpr (step_changes)
        c.changes = c.force * (c.next - c.velocity) * P(0.25 * (step.next - step.last));
}

/// Half of the way before and half of the way after a force.
template <typename P>
inline P mean_way(const Component<P>& c, const Steps& step)
{
    return c.velocity * P(0.5 * step.last) + c.next * P(0.5 * step.next);
}

/// Velocities as seen from a support that moves.
template <typename P>
Columns<P> against(const SupportMotion& support, const Columns<P>& velocity, const BlockMotion* motion, Index count)
{
    const Columns<P> pose(&motion->x, row_stride<BlockMotion>, count);
    Columns<P> seen = velocity;
    seen.a -= P(support.vx) - P(support.w) * (pose.b - P(support.y));
    seen.b -= P(support.vy) + P(support.w) * (pose.a - P(support.x));
    seen.c -= P(support.w);
    return seen;
}

template <typename P, bool step_changes>
void change_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& sums)
{
    const Steps step = blocks.step;
    const P dt = step.kick(), after = 0.5 * step.next;
    const P g_x = model.gravity.x(), g_y = model.gravity.y();
    DampingRule bounded = rule;
    bounded.global = min(rule.global, 1.0 / step.kick());  // it takes no more than the whole velocity in a cycle
    const bool has_global = rule.global != 0.0, rides = !rule.support.is_none();
    WorkLanes works(sums);
    for_groups<P>(
        range,
        [&](Index i, auto count)
        {
            const BasicActing<P> acting = load_acting<P>(&blocks.force[i], count);
            BasicInertia<P> inertia = load_inertia<P>(&blocks.inertia[i], count);
            hold_stopped(&blocks.rest[i], count, inertia);
            Columns<P> v(&blocks.motion[i].vx, row_stride<BlockMotion>, count);  // vx, vy, w, angle
            const P mass = load_some<P>(&model.mass[i], count);
            const BasicBlockDamping<P> damping = conditional_damping(acting, bounded);
            const Columns<P> seen = rides ? against(rule.support, v, &blocks.motion[i], count) : v;
            const DampedForce<P> damped = damp_translation(acting, inertia, seen.a, seen.b, dt, damping);
            const P damped_moment = damp_rotation(acting, inertia, seen.c, load_some<P>(&model.radius[i], count), dt, damping);
            Component<P> x{v.a, acting.x, damped.x, inertia.inverse_mass_x};
            Component<P> y{v.b, acting.y, damped.y, inertia.inverse_mass_y};
            Component<P> turn{v.c, acting.moment, damped_moment, inertia.inverse_inertia};
            for (Component<P>* const c : {&x, &y, &turn})
                advance<step_changes>(*c, damping.global, has_global, step);
            add_pack(works.holding, x.holding, y.holding, turn.holding);
            add_pack(works.local, x.local, y.local, turn.local);
            if (has_global)
                add_pack(works.global, x.global, y.global, turn.global);
            if constexpr (step_changes)
                add_pack(works.changes, x.changes, y.changes, turn.changes);
            add_pack(works.gravity, mass * (g_x * mean_way(x, step) + g_y * mean_way(y, step)));
            // Of contacts alone; what loads have in it is taken out by add_load_work.
            add_pack(works.coasting,
                     after * ((acting.x - mass * g_x) * x.next + (acting.y - mass * g_y) * y.next + acting.moment * turn.next));
            v.a = x.next;
            v.b = y.next;
            v.c = turn.next;
            v.store(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
        });
    sums = works.stored();
}

template <typename P>
void change_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works)
{
    if (blocks.step.next != blocks.step.last)
        change_velocities<P, true>(range, model, rule, blocks, works);
    else
        change_velocities<P, false>(range, model, rule, blocks, works);
}

/// Poses after one step with the given velocities; columns a to d: x, y, cosine, sine.
template <typename P>
inline void step(Columns<P>& pose, P& angle, P vx, P vy, P w, P dt)
{
    pose.a += vx * dt;
    pose.b += vy * dt;
    const P turn = w * dt;
    angle += turn;
    const P one = 1.0;
    const P q = P(0.5) * turn;
    const P scale = one / (one + q * q);
    const P cos_turn = (one - q * q) * scale;
    const P sin_turn = P(2.0) * q * scale;
    const P c = pose.c * cos_turn - pose.d * sin_turn;
    const P s = pose.d * cos_turn + pose.c * sin_turn;
    const P unit = P(1.5) - P(0.5) * (c * c + s * s);
    pose.c = c * unit;
    pose.d = s * unit;
}

inline double greatest(Pack p)
{
    return max(max(p.v[0], p.v[1]), max(p.v[2], p.v[3]));
}

template <typename P>
Travel change_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    const P dt = blocks.step.next;
    Pack fastest = 0.0, rim = 0.0, speed = 0.0;
    for_groups<P>(range,
                  [&](Index i, auto count)
                  {
                      Columns<P> v(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
                      Columns<P> pose(&blocks.motion[i].x, row_stride<BlockMotion>, count);
                      P vx = v.a, vy = v.b, w = v.c;
                      const P radius = load_some<P>(&model.radius[i], count), of_rim = radius * w;
                      max_pack(speed, vx * vx + vy * vy + of_rim * of_rim);
                      for (Index k = 0; pseudo != nullptr && k < count; ++k)
                      {
                          Triple& p = (*pseudo)[i + k];
                          vx.v[k] += p.x;
                          vy.v[k] += p.y;
                          w.v[k] += p.w;
                          p = {};
                      }
                      const P share = P(1.0) / load_some<P>(&blocks.margin[i], count, 1.0);
                      max_pack(fastest, (vx * vx + vy * vy) * share * share);
                      max_pack(rim, abs(w) * radius * share);
                      step(pose, v.d, vx, vy, w, dt);
                      pose.store(&blocks.motion[i].x, row_stride<BlockMotion>, count);
                      v.store(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
                  });
    return {.speed_share = greatest(fastest), .rim_share = greatest(rim), .speed_squared = greatest(speed)};
}
}  // namespace HDEM_LANES
}  // namespace hdem
