#include "core/motion/integrator.h"

#include "core/detection/edge_touch.h"
#include "core/motion/block_lanes.h"
#include "core/motion/rest.h"

#include <utility>

namespace hdem
{
namespace
{
bool acts(const Load& load, std::int64_t cycle)
{
    return cycle >= load.from && cycle < load.until;
}

/// Set one prescribed component. @return change of kinetic energy [J]
double prescribe(double& velocity, const std::optional<double>& value, double mass)
{
    if (!value)
        return 0.0;
    const double gain = 0.5 * mass * (*value * *value - velocity * velocity);
    velocity = *value;
    return gain;
}

enum class Prescription
{
    acts,
    ends  ///< velocities are zero again
};

void prescribe(const Load& load, const Model& model, Blocks& blocks, std::vector<Triple>& change, EnergyLedger& ledger,
               Prescription what)
{
    if (!load.velocity_x && !load.velocity_y && !load.angular_velocity)
        return;
    const auto now = [&](const std::optional<double>& value)
    { return what == Prescription::ends && value ? std::optional<double>(0.0) : value; };
    for (const Index i : load.blocks)
    {
        if (blocks.present[i] == 0)
            continue;
        BlockMotion& motion = blocks.motion[i];
        const BlockMotion was = motion;
        ledger.load_work += prescribe(motion.vx, now(load.velocity_x), model.mass[i]);
        ledger.load_work += prescribe(motion.vy, now(load.velocity_y), model.mass[i]);
        ledger.load_work += prescribe(motion.w, now(load.angular_velocity), model.inertia[i]);
        if (motion.vx == was.vx && motion.vy == was.vy && motion.w == was.w)
            continue;
        change.resize(static_cast<std::size_t>(blocks.size()));
        change[i] = {change[i].x + motion.vx - was.vx, change[i].y + motion.vy - was.vy, change[i].w + motion.w - was.w};
    }
}

/// Velocities of a contact's points if its blocks moved as given [m/s].
EdgeTouch touch_at_velocities(const Contacts& contacts, Index i, const Blocks& blocks, const std::vector<Triple>& velocity)
{
    BlockMotion ref = blocks.motion[contacts.ref[i]];
    BlockMotion inc = blocks.motion[contacts.inc[i]];
    const auto set = [](BlockMotion& motion, const Triple& v)
    {
        motion.vx = v.x;
        motion.vy = v.y;
        motion.w = v.w;
    };
    set(ref, velocity[contacts.ref[i]]);
    set(inc, velocity[contacts.inc[i]]);
    return touch_edges(contacts.edges(i), ref, inc);
}

bool is_moved(const Triple& v)
{
    return v.x != 0.0 || v.y != 0.0 || v.w != 0.0;
}

/// Work per second of the springs' last forces along such velocities, of the normal and of the shear springs [W].
struct SpringPower
{
    double normal = 0.0;
    double shear = 0.0;
};

SpringPower spring_power(IndexRange range, const Contacts& contacts, const Blocks& blocks, const std::vector<Triple>& velocity)
{
    SpringPower power;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const bool spring = is_spring(contacts.regime[0][i]) || is_spring(contacts.regime[1][i]);
        if (!spring || !(is_moved(velocity[contacts.ref[i]]) || is_moved(velocity[contacts.inc[i]])))
            continue;
        const EdgeTouch touch = touch_at_velocities(contacts, i, blocks, velocity);
        for (int k = 0; k < 2; ++k)
        {
            if (!is_spring(contacts.regime[k][i]))
                continue;
            power.normal -= contacts.normal_force(k, i) * touch.point[k].v_m;
            power.shear += contacts.shear_force(k, i) * touch.point[k].v_t;
        }
    }
    return power;
}

/// Stopped blocks do not move, whatever acts on them.
inline void hold_stopped(const std::uint8_t* rest, Index count, BasicInertia<Pack>& inertia)
{
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
    Pack weight;   ///< gravity's share of the force
};

/// Works of a range of blocks.
struct Works
{
    Pack gravity = 0.0, holding = 0.0, local = 0.0, global = 0.0;

    void add_to(EnergyLedger& ledger) const
    {
        ledger.gravity_work += sum(gravity);
        ledger.load_work -= sum(holding);
        ledger.local_damping += sum(local);
        ledger.global_damping += sum(global);
    }
};

/// New velocity; books the works of this component.
inline Pack advance(Pack velocity, const Component& c, Pack global, bool has_global, Pack dt, Works& works)
{
    const Pack zero = 0.0;
    const Mask is_free = c.inverse > zero;
    const Pack kept = has_global ? select(is_free, velocity * (Pack(1.0) - global * dt), velocity) : velocity;
    const Pack next = kept + c.damped * c.inverse * dt;
    const Pack way = Pack(0.5) * (velocity + next) * dt;
    works.gravity += c.weight * way;
    works.holding += select(is_free, zero, c.force * way);  // what holds a prescribed motion
    works.local += select(is_free, (c.force - c.damped) * way, zero);
    if (has_global)
        works.global += select(is_free, global * velocity / c.inverse * way, zero);
    return next;
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
}  // namespace

void apply_loads(const Model& model, std::int64_t cycle, const Blocks& blocks, std::vector<Triple>& external,
                 std::vector<Triple>& before)
{
    before.clear();
    for (const Load& load : model.loads)
        for (const Index i : load.blocks)
            external[i] = {};
    for (const Load& load : model.loads)
    {
        if (!acts(load, cycle))
            continue;
        for (const Index i : load.blocks)
        {
            if (blocks.present[i] == 0)
                continue;
            external[i].x += model.mass[i] * load.acceleration.x() + load.force.x();
            external[i].y += model.mass[i] * load.acceleration.y() + load.force.y();
            external[i].w += load.moment;
            const BlockMotion& motion = blocks.motion[i];
            before.push_back({motion.vx, motion.vy, motion.w});
        }
    }
}

void prescribe_motions(const Model& model, std::int64_t cycle, const Contacts& contacts, Blocks& blocks, EnergyLedger& ledger)
{
    std::vector<Triple> change;
    // What a load prescribed ends with it; first, so that another load may take over in the same cycle, wherever it is listed.
    for (const Load& load : model.loads)
        if (cycle == load.until && load.from < load.until)
            prescribe(load, model, blocks, change, ledger, Prescription::ends);
    for (const Load& load : model.loads)
        if (acts(load, cycle))
            prescribe(load, model, blocks, change, ledger, Prescription::acts);
    if (change.empty())
        return;
    // The last force has worked for half a step along the old velocity. The contacts will book that half along the new one.
    const SpringPower power = spring_power({0, contacts.size()}, contacts, blocks, change);
    ledger.load_work -= 0.5 * model.time_step * (power.normal + power.shear);
}

void add_load_work(const Model& model, std::int64_t cycle, const Blocks& blocks, const std::vector<Triple>& before,
                   EnergyLedger& ledger)
{
    std::size_t at = 0;
    for (const Load& load : model.loads)
        if (acts(load, cycle))
            for (const Index i : load.blocks)
            {
                if (blocks.present[i] == 0)
                    continue;
                const BlockMotion& motion = blocks.motion[i];
                const Triple& was = before[at++];
                const Vec2 force = model.mass[i] * load.acceleration + load.force;
                ledger.load_work += 0.5 * model.time_step *
                                    (force.x() * (was.x + motion.vx) + force.y() * (was.y + motion.vy) +
                                     load.moment * (was.w + motion.w));
            }
}

void update_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, EnergyLedger& ledger)
{
    const Pack dt = model.time_step;
    const Pack g_x = model.gravity.x(), g_y = model.gravity.y();
    const bool has_global = model.damping.global_damping_ratio * model.damping.average_frequency != 0.0;
    Works works;
    for_groups(
        range,
        [&](Index i, Index count)
        {
            const BasicActing<Pack> acting = load_acting(&blocks.force[i], count);
            BasicInertia<Pack> inertia = load_inertia(&blocks.inertia[i], count);
            hold_stopped(&blocks.rest[i], count, inertia);
            Columns v(&blocks.motion[i].vx, row_stride<BlockMotion>, count);  // vx, vy, w, angle
            const Pack mass = load_some(&model.mass[i], count);
            const BasicBlockDamping<Pack> damping = conditional_damping(acting, rule, model.damping);
            const DampedForce<Pack> damped = damp_translation(acting, inertia, v.a, v.b, dt, damping);
            const Pack damped_moment = damp_rotation(acting, inertia, v.c, dt, damping);
            v.a = advance(v.a, {acting.x, damped.x, inertia.inverse_mass_x, mass * g_x}, damping.global, has_global, dt, works);
            v.b = advance(v.b, {acting.y, damped.y, inertia.inverse_mass_y, mass * g_y}, damping.global, has_global, dt, works);
            v.c = advance(v.c, {acting.moment, damped_moment, inertia.inverse_inertia, 0.0}, damping.global, has_global, dt, works);
            v.store(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
        });
    works.add_to(ledger);
}

double update_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    const Pack dt = model.time_step;
    Pack fastest = 0.0, rim = 0.0;
    for_groups(range,
               [&](Index i, Index count)
               {
                   Columns v(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
                   Columns pose(&blocks.motion[i].x, row_stride<BlockMotion>, count);
                   Pack vx = v.a, vy = v.b, w = v.c;
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
                   rim = max(rim, abs(w) * load_some(&model.radius[i], count) * share);
                   step(pose, v.d, vx, vy, w, dt);
                   pose.store(&blocks.motion[i].x, row_stride<BlockMotion>, count);
                   v.store(&blocks.motion[i].vx, row_stride<BlockMotion>, count);
               });
    return (std::sqrt(greatest(fastest)) + greatest(rim)) * model.time_step;
}

void add_correction_gravity(IndexRange range, const Model& model, const Blocks& blocks, const std::vector<Triple>& pseudo,
                            EnergyLedger& ledger)
{
    double gravity = 0.0;
    for (Index i = range.begin; i < range.end; ++i)
        if (is_moved(pseudo[i]) && blocks.present[i] != 0)
            gravity += model.mass[i] * (model.gravity.x() * pseudo[i].x + model.gravity.y() * pseudo[i].y) * model.time_step;
    ledger.gravity_work += gravity;
    ledger.position_correction -= gravity;
}

void add_correction_springs(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                            const std::vector<Triple>& pseudo, EnergyLedger& ledger)
{
    // The contacts will find overlaps that no velocity explains, and book their work as if it had come from nowhere.
    const double work = -spring_power(range, contacts, blocks, pseudo).normal * model.time_step;
    ledger.position_correction += work;
    ledger.contact_changes += work;
}
}  // namespace hdem
