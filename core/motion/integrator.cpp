#include "core/motion/integrator.h"

#include "core/detection/edge_touch.h"
#include "core/motion/damping.h"

#include <utility>

namespace hdem
{
void apply_weights(IndexRange range, const Model& model, const std::vector<Triple>& external, Blocks& blocks)
{
    for (Index i = range.begin; i < range.end; ++i)
    {
        const double mass = blocks.present[i] != 0 ? model.mass[i] : 0.0;
        const Triple more = external.empty() ? Triple{} : external[i];
        blocks.force[i] = {.x = mass * model.gravity.x() + more.x, .y = mass * model.gravity.y() + more.y, .moment = more.w};
    }
}

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
    const EdgePair edges = contacts.edges(i);
    return touch_edges(edges, view_edges(edges, ref, inc), ref, inc);
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

/// One step of a pose.
inline void step(BlockMotion& motion, double vx, double vy, double w, double dt)
{
    motion.x += vx * dt;
    motion.y += vy * dt;
    const double turn = w * dt;
    motion.angle += turn;
    const double q = 0.5 * turn;
    const double scale = 1.0 / (1.0 + q * q);
    const double cos_turn = (1.0 - q * q) * scale;
    const double sin_turn = 2.0 * q * scale;
    const double c = motion.c * cos_turn - motion.s * sin_turn;
    const double s = motion.s * cos_turn + motion.c * sin_turn;
    const double unit = 1.5 - 0.5 * (c * c + s * s);
    motion.c = c * unit;
    motion.s = s * unit;
}

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

/// One component of a block's motion over one step.
struct Component
{
    double force;    ///< net, before damping
    double damped;   ///< after local damping
    double inverse;  ///< inverse mass or inertia, 0 where the motion is prescribed
    double weight;   ///< gravity's share of the force
};

/// New velocity; books the works of this component.
inline double advance(double velocity, const Component& c, double global, double dt, EnergyLedger& ledger)
{
    const bool is_free = c.inverse > 0.0;
    const double kept = is_free ? velocity * (1.0 - global * dt) : velocity;
    const double next = kept + c.damped * c.inverse * dt;
    const double way = 0.5 * (velocity + next) * dt;
    ledger.gravity_work += c.weight * way;
    ledger.load_work -= is_free ? 0.0 : c.force * way;  // what holds a prescribed motion
    ledger.local_damping += is_free ? (c.force - c.damped) * way : 0.0;
    ledger.global_damping += is_free ? global * velocity / c.inverse * way : 0.0;
    return next;
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

void update_velocities(IndexRange range, const Model& model, DampingPreset preset, Blocks& blocks, EnergyLedger& ledger)
{
    const double dt = model.time_step;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const BlockForce& force = blocks.force[i];
        const BlockInertia& inertia = blocks.inertia[i];
        BlockMotion& motion = blocks.motion[i];
        const BlockDamping damping = conditional_damping(force, preset, model.damping);
        const double mass = blocks.present[i] != 0 ? model.mass[i] : 0.0;
        const Vec2 damped = locally_damped(force, inertia, motion.vx, motion.vy, damping);
        const double damped_moment = locally_damped(force.moment, motion.w, damping.local_rotation);
        motion.vx = advance(motion.vx, {force.x, damped.x(), inertia.inverse_mass_x, mass * model.gravity.x()}, damping.global, dt,
                            ledger);
        motion.vy = advance(motion.vy, {force.y, damped.y(), inertia.inverse_mass_y, mass * model.gravity.y()}, damping.global, dt,
                            ledger);
        motion.w = advance(motion.w, {force.moment, damped_moment, inertia.inverse_inertia, 0.0}, damping.global, dt, ledger);
    }
}

double update_positions(IndexRange range, const Model& model, Blocks& blocks)
{
    double fastest = 0.0, rim = 0.0;
    for (Index i = range.begin; i < range.end; ++i)
    {
        BlockMotion& motion = blocks.motion[i];
        fastest = max(fastest, motion.vx * motion.vx + motion.vy * motion.vy);
        rim = max(rim, std::abs(motion.w) * model.radius[i]);
        step(motion, motion.vx, motion.vy, motion.w, model.time_step);
    }
    return (std::sqrt(fastest) + rim) * model.time_step;
}

double update_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>& pseudo)
{
    double fastest = 0.0, rim = 0.0;
    for (Index i = range.begin; i < range.end; ++i)
    {
        BlockMotion& motion = blocks.motion[i];
        const double vx = motion.vx + pseudo[i].x;
        const double vy = motion.vy + pseudo[i].y;
        const double w = motion.w + pseudo[i].w;
        fastest = max(fastest, vx * vx + vy * vy);
        rim = max(rim, std::abs(w) * model.radius[i]);
        step(motion, vx, vy, w, model.time_step);
        pseudo[i] = {};
    }
    return (std::sqrt(fastest) + rim) * model.time_step;
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
