#include "core/motion/loads.h"

#include "core/state/stage_cycles.h"

#include <cmath>
#include <limits>
#include <set>

namespace hdem
{
namespace
{
/// Does a load act at a cycle, counted from where its own times begin?
bool acts_at(const Load& load, std::int64_t cycle)
{
    return cycle >= load.from && cycle < load.until;
}

bool acts(const Load& load, const State& state)
{
    return acts_at(load, cycles_since(load.factor.since, state));
}

double factor_of(const Load& load, const Model& model, const State& state)
{
    return load.factor.varies() ? load.factor.at(cycles_since(load.factor.since, state), model.time_step) : 1.0;
}

/// Moment of a force about the centroid. Its arm turns with the block [N m].
double moment_of(const Vec2& force, const Vec2& arm, const BlockMotion& motion)
{
    const Vec2 turned(motion.c * arm.x() - motion.s * arm.y(), motion.s * arm.x() + motion.c * arm.y());
    return cross(turned, force);
}

/// Add a load's forces in this cycle to `external`, one entry a block. @param use  is told the motion of each loaded block, and the load's moment on it
template <typename Use>
void add_load(const Load& load, const Model& model, const State& state, std::vector<Triple>& external, const Use& use)
{
    const double factor = factor_of(load, model, state);
    for (std::size_t k = 0; k < load.blocks.size(); ++k)
    {
        const Index i = load.blocks[k];
        if (state.blocks.present[i] == 0)
            continue;
        const BlockMotion& motion = state.blocks.motion[i];
        const double moment = factor * (load.moment + (load.arm.empty() ? 0.0 : moment_of(load.force, load.arm[k], motion)));
        external[i].x += factor * (model.mass[i] * load.acceleration.x() + load.force.x());
        external[i].y += factor * (model.mass[i] * load.acceleration.y() + load.force.y());
        external[i].w += moment;
        use(motion, moment);
    }
}

/// Set one prescribed component, unless a stage has freed it. @return change of kinetic energy [J]
double prescribe(double& velocity, const std::optional<double>& value, double mass, double inverse_mass)
{
    if (!value || inverse_mass > 0.0)
        return 0.0;
    const double gain = 0.5 * mass * (*value * *value - velocity * velocity);
    velocity = *value;
    return gain;
}

/// @param factor  of the prescribed velocities
void prescribe(const Load& load, double factor, const Model& model, State& state)
{
    if (!load.prescribes())
        return;
    const auto now = [&](const std::optional<double>& value) { return value ? std::optional<double>(factor * *value) : value; };
    for (const Index i : load.blocks)
    {
        if (state.blocks.present[i] == 0)
            continue;
        BlockMotion& motion = state.blocks.motion[i];
        const BlockInertia& free = state.blocks.inertia[i];
        state.ledger.load_work += prescribe(motion.vx, now(load.velocity_x), model.mass[i], free.inverse_mass_x);
        state.ledger.load_work += prescribe(motion.vy, now(load.velocity_y), model.mass[i], free.inverse_mass_y);
        state.ledger.load_work += prescribe(motion.w, now(load.angular_velocity), model.inertia[i], free.inverse_inertia);
    }
}
}  // namespace

SupportMotion support_motion(const Model& model, const State& state)
{
    SupportMotion support;
    bool is_found = false;
    for (Index i = 0; i < state.blocks.size(); ++i)
    {
        const BlockInertia& free = state.blocks.inertia[i];
        const int held = (free.inverse_mass_x == 0.0 ? 1 : 0) + (free.inverse_mass_y == 0.0 ? 1 : 0) +
                         (free.inverse_inertia == 0.0 ? 1 : 0);
        if (held == 0 || state.blocks.present[i] == 0)
            continue;
        if (held < 3)
            return {};
        const BlockMotion& m = state.blocks.motion[i];
        if (!is_found)
            support = {m.x, m.y, m.vx, m.vy, m.w};
        is_found = true;
        const Vec2 there(support.vx - support.w * (m.y - support.y), support.vy + support.w * (m.x - support.x));
        const double near = 1e-9 * (there.norm() + std::abs(support.w) * model.radius[i]);
        if ((Vec2(m.vx, m.vy) - there).norm() > near || std::abs(m.w - support.w) * model.radius[i] > near)
            return {};
    }
    return support;
}

void time_loads(Model& model)
{
    constexpr std::int64_t for_ever = std::numeric_limits<std::int64_t>::max();
    const auto cycle_of = [&](double time)
    {
        const double cycle = std::ceil(time / model.time_step * (1.0 - 1e-12));
        return cycle < 9.0e18 ? static_cast<std::int64_t>(cycle) : for_ever;
    };
    for (Load& load : model.loads)
    {
        const Interval& when = load.interval;
        load.from = when.from_cycle ? *when.from_cycle : (when.from_time ? cycle_of(*when.from_time) : 0);
        load.until = when.until_cycle ? *when.until_cycle : (when.until_time ? cycle_of(*when.until_time) : for_ever);
    }
}

double last_factor_of(const Load& load, const Model& model, const State& state)
{
    const std::int64_t last = cycles_since(load.factor.since, state) - 1;
    return acts_at(load, last) ? load.factor.at(last, model.time_step) : 0.0;
}

void apply_loads(const Model& model, const State& state, const std::vector<Triple>& constant, std::vector<Triple>& external,
                 std::vector<LoadedBlock>& before)
{
    before.clear();
    for (const Load& load : model.loads)
        for (const Index i : load.blocks)
            external[i] = constant.empty() ? Triple{} : constant[i];
    for (const Load& load : model.loads)
        if (acts(load, state))
            add_load(load, model, state, external,
                     [&](const BlockMotion& motion, double moment) {
                         before.push_back({motion.vx, motion.vy, motion.w, moment});
                     });
}

void add_lasting_loads(const Model& model, const State& state, std::int64_t cycles, std::vector<Triple>& forces)
{
    for (const Load& load : model.loads)
        if (acts(load, state) && acts_at(load, cycles_since(load.factor.since, state) + cycles))
            add_load(load, model, state, forces, [](const BlockMotion&, double) {});
}

void prescribe_motions(const Model& model, State& state)
{
    // What a load prescribed ends with it; first, so that another load may take over in the same cycle, wherever it is listed.
    for (const Load& load : model.loads)
        if (cycles_since(load.factor.since, state) == load.until && load.from < load.until)
            prescribe(load, 0.0, model, state);
    for (const Load& load : model.loads)
        if (acts(load, state))
            prescribe(load, factor_of(load, model, state), model, state);
}

void add_load_work(const Model& model, const std::vector<LoadedBlock>& before, State& state)
{
    std::size_t at = 0;
    const Blocks& blocks = state.blocks;
    for (const Load& load : model.loads)
    {
        if (!acts(load, state))
            continue;
        const double factor = factor_of(load, model, state);
        for (const Index i : load.blocks)
        {
            if (blocks.present[i] == 0)
                continue;
            const BlockMotion& motion = blocks.motion[i];
            const LoadedBlock& was = before[at++];
            const Vec2 force = factor * (model.mass[i] * load.acceleration + load.force);
            const auto power = [&](double x, double y, double w) { return force.x() * x + force.y() * y + was.moment * w; };
            const double after = 0.5 * blocks.step.next * power(motion.vx, motion.vy, motion.w);
            state.ledger.load_work += 0.5 * blocks.step.last * power(was.vx, was.vy, was.w) + after;
            state.ledger.coasting -= after;
        }
    }
}

std::vector<Index> loaded_blocks(const Model& model)
{
    std::set<Index> loaded;
    for (const Load& load : model.loads)
        loaded.insert(load.blocks.begin(), load.blocks.end());
    return {loaded.begin(), loaded.end()};
}
}  // namespace hdem
