// Compiled for several kinds of processors: core/kernels.h.
#include "core/kernels_here.h"
#include "core/motion/block_lanes.h"
#include "core/motion/integrator.h"
#include "core/motion/rest.h"

#include <bit>

namespace hdem
{
inline namespace HDEM_LANES
{
namespace
{
/// Stopped blocks do not move, whatever acts on them.
inline void hold_stopped(const std::uint8_t* rest, Index count, BasicInertia<Pack>& inertia)
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

/// One component of the motion of four blocks over one step.
struct Component
{
    Pack force;    ///< net, before damping
    Pack damped;   ///< after local damping
    Pack inverse;  ///< inverse mass or inertia, 0 where the motion is prescribed
};

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

/// New velocity; books the works of this component. The kinetic energy changes by each force times the mean of both velocities and the mean of both steps;
/// springs, weight and loads are booked by the mean of both ways, (v last + v' next) / 2. Where the step changes the first is F (v' - v) (next - last) / 4 less.
template <bool step_changes>
inline Pack advance(Pack velocity, const Component& c, Pack global, bool has_global, const Steps& step, WorkLanes& works)
{
    const Pack zero = 0.0;
    const Pack dt = step.kick();
    const Mask is_free = c.inverse > zero;
    const Pack kept = has_global ? select(is_free, velocity * (Pack(1.0) - global * dt), velocity) : velocity;
    const Pack next = kept + c.damped * c.inverse * dt;
    const Pack way = Pack(0.5) * (velocity + next) * dt;
    works.holding += select(is_free, zero, c.force * way);  // what holds a prescribed motion
    works.local += select(is_free, (c.force - c.damped) * way, zero);
    if (has_global)
        works.global += select(is_free, global * velocity / c.inverse * way, zero);
    if constexpr (step_changes)
        works.changes += c.force * (next - velocity) * Pack(0.25 * (step.next - step.last));
    return next;
}

/// Half of the way before and half of the way after a force.
inline Pack mean_way(Pack velocity, Pack next, const Steps& step)
{
    return velocity * Pack(0.5 * step.last) + next * Pack(0.5 * step.next);
}

/// Pose of four blocks after one step with the given velocities; columns a to d: x, y, cosine, sine.
inline void step(Columns& pose, Pack& angle, Pack vx, Pack vy, Pack w, Pack dt)
{
    pose.a += vx * dt;
    pose.b += vy * dt;
    const Pack turn = w * dt;
    angle += turn;
    const Pack one = 1.0;
    const Pack q = Pack(0.5) * turn;
    const Pack scale = one / (one + q * q);
    const Pack cos_turn = (one - q * q) * scale;
    const Pack sin_turn = Pack(2.0) * q * scale;
    const Pack c = pose.c * cos_turn - pose.d * sin_turn;
    const Pack s = pose.d * cos_turn + pose.c * sin_turn;
    const Pack unit = Pack(1.5) - Pack(0.5) * (c * c + s * s);
    pose.c = c * unit;
    pose.d = s * unit;
}

double greatest(Pack p)
{
    return max(max(p.v[0], p.v[1]), max(p.v[2], p.v[3]));
}

/// Velocities as seen from a support that moves.
Columns against(const SupportMotion& support, const Columns& velocity, const BlockMotion* motion, Index count)
{
    const Columns pose(&motion->x, row_stride<BlockMotion>, count);
    Columns seen = velocity;
    seen.a -= Pack(support.vx) - Pack(support.w) * (pose.b - Pack(support.y));
    seen.b -= Pack(support.vy) + Pack(support.w) * (pose.a - Pack(support.x));
    seen.c -= Pack(support.w);
    return seen;
}

template <bool step_changes>
void change_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& sums)
{
    const Steps step = blocks.step;
    const Pack dt = step.kick(), after = 0.5 * step.next;
    const Pack g_x = model.gravity.x(), g_y = model.gravity.y();
    DampingRule bounded = rule;
    bounded.global = min(rule.global, 1.0 / step.kick());  // it takes no more than the whole velocity in a cycle
    const bool has_global = rule.global != 0.0, rides = !rule.support.is_none();
    WorkLanes works(sums);
    for_groups(range,
               [&](Index i, auto count)
               {
                   const BasicActing<Pack> acting = load_acting(&blocks.force[i], count);
                   BasicInertia<Pack> inertia = load_inertia(&blocks.inertia[i], count);
                   hold_stopped(&blocks.rest[i], count, inertia);
                   Columns v(&blocks.motion[i].vx, row_stride<BlockMotion>, count);  // vx, vy, w, angle
                   const Pack mass = load_some(&model.mass[i], count);
                   const BasicBlockDamping<Pack> damping = conditional_damping(acting, bounded);
                   const Columns seen = rides ? against(rule.support, v, &blocks.motion[i], count) : v;
                   const DampedForce<Pack> damped = damp_translation(acting, inertia, seen.a, seen.b, dt, damping);
                   const Pack damped_moment = damp_rotation(acting, inertia, seen.c, load_some(&model.radius[i], count), dt,
                                                            damping);
                   const auto renew = [&](Pack velocity, const Component& c)
                   { return advance<step_changes>(velocity, c, damping.global, has_global, step, works); };
                   const Pack vx = renew(v.a, {acting.x, damped.x, inertia.inverse_mass_x});
                   const Pack vy = renew(v.b, {acting.y, damped.y, inertia.inverse_mass_y});
                   const Pack w = renew(v.c, {acting.moment, damped_moment, inertia.inverse_inertia});
                   works.gravity += mass * (g_x * mean_way(v.a, vx, step) + g_y * mean_way(v.b, vy, step));
                   // Of contacts alone; what loads have in it is taken out by add_load_work.
                   works.coasting += after * ((acting.x - mass * g_x) * vx + (acting.y - mass * g_y) * vy + acting.moment * w);
                   v.a = vx;
                   v.b = vy;
                   v.c = w;
                   v.store(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
               });
    sums = works.stored();
}
}  // namespace

void advance_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works)
{
    if (blocks.step.next != blocks.step.last)
        change_velocities<true>(range, model, rule, blocks, works);
    else
        change_velocities<false>(range, model, rule, blocks, works);
}

Travel advance_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    const Pack dt = blocks.step.next;
    Pack fastest = 0.0, rim = 0.0, speed = 0.0;
    for_groups(range,
               [&](Index i, auto count)
               {
                   Columns v(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
                   Columns pose(&blocks.motion[i].x, row_stride<BlockMotion>, count);
                   Pack vx = v.a, vy = v.b, w = v.c;
                   const Pack radius = load_some(&model.radius[i], count), of_rim = radius * w;
                   speed = max(speed, vx * vx + vy * vy + of_rim * of_rim);
                   for (Index k = 0; pseudo != nullptr && k < count; ++k)
                   {
                       Triple& p = (*pseudo)[i + k];
                       vx.v[k] += p.x;
                       vy.v[k] += p.y;
                       w.v[k] += p.w;
                       p = {};
                   }
                   const Pack share = Pack(1.0) / load_some(&blocks.margin[i], count, 1.0);
                   fastest = max(fastest, (vx * vx + vy * vy) * share * share);
                   rim = max(rim, abs(w) * radius * share);
                   step(pose, v.d, vx, vy, w, dt);
                   pose.store(&blocks.motion[i].x, row_stride<BlockMotion>, count);
                   v.store(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
               });
    return {.way = (std::sqrt(greatest(fastest)) + greatest(rim)) * blocks.step.next, .speed_squared = greatest(speed)};
}
}  // namespace HDEM_LANES
}  // namespace hdem
