#include "core/motion/loads.h"

namespace hdem
{
namespace
{
bool acts(const Load& load, std::int64_t cycle)
{
    return cycle >= load.from && cycle < load.until;
}

/// Of a force about the centroid. Its arm turns with the block [N m].
double moment_of(const Vec2& force, const Vec2& arm, const BlockMotion& motion)
{
    const Vec2 turned(motion.c * arm.x() - motion.s * arm.y(), motion.s * arm.x() + motion.c * arm.y());
    return cross(turned, force);
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
    if (!load.velocity_x && !load.velocity_y && !load.angular_velocity)
        return;
    const auto now = [&](const std::optional<double>& value)
    { return what == Prescription::ends && value ? std::optional<double>(0.0) : value; };
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
}  // namespace

void apply_loads(const Model& model, std::int64_t cycle, const Blocks& blocks, const std::vector<Triple>& constant,
                 std::vector<Triple>& external, std::vector<LoadedBlock>& before)
{
    before.clear();
    for (const Load& load : model.loads)
        for (const Index i : load.blocks)
            external[i] = constant.empty() ? Triple{} : constant[i];
    for (const Load& load : model.loads)
    {
        if (!acts(load, cycle))
            continue;
        for (std::size_t k = 0; k < load.blocks.size(); ++k)
        {
            const Index i = load.blocks[k];
            if (blocks.present[i] == 0)
                continue;
            const BlockMotion& motion = blocks.motion[i];
            const double moment = load.moment + (load.arm.empty() ? 0.0 : moment_of(load.force, load.arm[k], motion));
            external[i].x += model.mass[i] * load.acceleration.x() + load.force.x();
            external[i].y += model.mass[i] * load.acceleration.y() + load.force.y();
            external[i].w += moment;
            before.push_back({motion.vx, motion.vy, motion.w, moment});
        }
    }
}

void prescribe_motions(const Model& model, std::int64_t cycle, Blocks& blocks, EnergyLedger& ledger)
{
    // What a load prescribed ends with it; first, so that another load may take over in the same cycle, wherever it is listed.
    for (const Load& load : model.loads)
        if (cycle == load.until && load.from < load.until)
            prescribe(load, model, blocks, ledger, Prescription::ends);
    for (const Load& load : model.loads)
        if (acts(load, cycle))
            prescribe(load, model, blocks, ledger, Prescription::acts);
}

void add_load_work(const Model& model, std::int64_t cycle, const Blocks& blocks, const std::vector<LoadedBlock>& before,
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
                const LoadedBlock& was = before[at++];
                const Vec2 force = model.mass[i] * load.acceleration + load.force;
                const auto power = [&](double x, double y, double w) { return force.x() * x + force.y() * y + was.moment * w; };
                const double after = 0.5 * blocks.step.next * power(motion.vx, motion.vy, motion.w);
                ledger.load_work += 0.5 * blocks.step.last * power(was.vx, was.vy, was.w) + after;
                ledger.coasting -= after;
            }
}
}  // namespace hdem
