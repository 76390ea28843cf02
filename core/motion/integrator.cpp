#include "core/motion/integrator.h"

#include "core/motion/damping.h"

namespace hdem
{
void apply_weights(IndexRange range, const Model& model, Blocks& blocks)
{
    for (Index i = range.begin; i < range.end; ++i)
    {
        const double mass = blocks.present[i] != 0 ? model.mass[i] : 0.0;
        blocks.force[i] = {.x = mass * model.gravity.x(), .y = mass * model.gravity.y()};
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

void prescribe(const Load& load, const Model& model, Blocks& blocks, EnergyLedger& ledger, Prescription what)
{
    const auto now = [&](const std::optional<double>& value) { return what == Prescription::ends && value ? std::optional<double>(0.0) : value; };
    for (const Index i : load.blocks)
    {
        if (blocks.present[i] == 0)
            continue;
        BlockMotion& motion = blocks.motion[i];
        ledger.load_work += prescribe(motion.vx, now(load.velocity_x), model.mass[i]);
        ledger.load_work += prescribe(motion.vy, now(load.velocity_y), model.mass[i]);
        ledger.load_work += prescribe(motion.w, now(load.angular_velocity), model.inertia[i]);
    }
}

/// One component of a block's motion over one step.
struct Component
{
    double force;      ///< net, before damping
    double inverse;    ///< inverse mass or inertia, 0 where the motion is prescribed
    double weight;     ///< gravity's share of the force
};

/// New velocity; books the works of this component.
inline double advance(double velocity, const Component& c, const BlockDamping& damping, double dt, EnergyLedger& ledger)
{
    const bool is_free = c.inverse > 0.0;
    const double damped = locally_damped(c.force, velocity, damping.local);
    const double kept = is_free ? velocity * (1.0 - damping.global * dt) : velocity;
    const double next = kept + damped * c.inverse * dt;
    const double way = 0.5 * (velocity + next) * dt;
    ledger.gravity_work += c.weight * way;
    ledger.load_work -= is_free ? 0.0 : c.force * way;  // what holds a prescribed motion
    ledger.local_damping += is_free ? (c.force - damped) * way : 0.0;
    ledger.global_damping += is_free ? damping.global * velocity / c.inverse * way : 0.0;
    return next;
}
}  // namespace

void apply_loads(const Model& model, std::int64_t cycle, Blocks& blocks, std::vector<Triple>& before, EnergyLedger& ledger)
{
    before.clear();
    // What a load prescribed ends with it; first, so that another load may take over in the same cycle, wherever it is listed.
    for (const Load& load : model.loads)
        if (cycle == load.until && load.from < load.until)
            prescribe(load, model, blocks, ledger, Prescription::ends);
    for (const Load& load : model.loads)
    {
        if (!acts(load, cycle))
            continue;
        prescribe(load, model, blocks, ledger, Prescription::acts);
        for (const Index i : load.blocks)
        {
            if (blocks.present[i] == 0)
                continue;
            blocks.force[i].x += model.mass[i] * load.acceleration.x() + load.force.x();
            blocks.force[i].y += model.mass[i] * load.acceleration.y() + load.force.y();
            blocks.force[i].moment += load.moment;
            const BlockMotion& motion = blocks.motion[i];
            before.push_back({motion.vx, motion.vy, motion.w});
        }
    }
}

void add_load_work(const Model& model, std::int64_t cycle, const Blocks& blocks, const std::vector<Triple>& before, EnergyLedger& ledger)
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
                                    (force.x() * (was.x + motion.vx) + force.y() * (was.y + motion.vy) + load.moment * (was.w + motion.w));
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
        motion.vx = advance(motion.vx, {force.x, inertia.inverse_mass_x, mass * model.gravity.x()}, damping, dt, ledger);
        motion.vy = advance(motion.vy, {force.y, inertia.inverse_mass_y, mass * model.gravity.y()}, damping, dt, ledger);
        motion.w = advance(motion.w, {force.moment, inertia.inverse_inertia, 0.0}, damping, dt, ledger);
    }
}

void update_positions(IndexRange range, double dt, Blocks& blocks, std::vector<Triple>& pseudo)
{
    for (Index i = range.begin; i < range.end; ++i)
    {
        BlockMotion& motion = blocks.motion[i];
        Triple& p = pseudo[i];
        motion.x += (motion.vx + p.x) * dt;
        motion.y += (motion.vy + p.y) * dt;
        const double turn = (motion.w + p.w) * dt;
        motion.angle += turn;
        const double q = 0.5 * turn;
        const double scale = 1.0 / (1.0 + q * q);
        const double cos_turn = (1.0 - q * q) * scale;
        const double sin_turn = 2.0 * q * scale;
        const double c = motion.c * cos_turn - motion.s * sin_turn;
        motion.s = motion.s * cos_turn + motion.c * sin_turn;
        motion.c = c;
        p = {};
    }
}

void add_correction_work(IndexRange range, const Model& model, const Blocks& blocks, const std::vector<Triple>& pseudo, EnergyLedger& ledger)
{
    const double dt = model.time_step;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const Triple& p = pseudo[i];
        if ((p.x == 0.0 && p.y == 0.0 && p.w == 0.0) || blocks.present[i] == 0)
            continue;
        const BlockForce& force = blocks.force[i];
        const Vec2 weight = model.mass[i] * model.gravity;
        const double gravity = (weight.x() * p.x + weight.y() * p.y) * dt;
        const double springs = ((force.x - weight.x()) * p.x + (force.y - weight.y()) * p.y + force.moment * p.w) * dt;
        ledger.gravity_work += gravity;
        ledger.position_correction -= gravity + springs;
    }
}
}  // namespace hdem
