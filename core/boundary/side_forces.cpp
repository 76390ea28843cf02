#include "core/boundary/side_forces.h"

#include "core/state/stage_cycles.h"

#include <set>

namespace hdem
{
namespace
{
double power(const Triple& force, const BlockMotion& motion)
{
    return force.x * motion.vx + force.y * motion.vy + force.w * motion.w;
}
}  // namespace

BoundaryForce force_of_traction(const BoundaryFace& face, const Vec2& first, const Vec2& second)
{
    const double sixth = (face.to - face.from).norm() / 6.0;
    const Vec2 at_from = sixth * (2.0 * first + second), at_to = sixth * (first + 2.0 * second);
    const Vec2 sum = at_from + at_to;
    const auto arms = [&](int of_arm, int of_force)
    { return face.body_from[of_arm] * at_from[of_force] + face.body_to[of_arm] * at_to[of_force]; };
    return {.block = face.block,
            .x = sum.x(),
            .y = sum.y(),
            .moment = arms(0, 1) - arms(1, 0),
            .xx = arms(0, 0),
            .yy = arms(1, 1),
            .xy = 0.5 * (arms(0, 1) + arms(1, 0))};
}

double factor_of(const Boundary& boundary, const Model& model, const State& state)
{
    return boundary.factor.varies() ? boundary.factor.at(cycles_since(boundary.factor.since, state), model.time_step) : 1.0;
}

std::vector<Index> pushed_blocks(const Model& model, const State& state)
{
    std::set<Index> pushed;
    for (const Boundary& boundary : model.boundaries)
        for (const BoundaryForce& force : boundary.forces)
            if (boundary.acts(state.stage) && state.blocks.present[force.block] != 0)
                pushed.insert(force.block);
    for (Index b = 0; b < static_cast<Index>(state.water.size()); ++b)
        if (const Triple& f = state.water[b]; state.blocks.present[b] != 0 && (f.x != 0.0 || f.y != 0.0 || f.w != 0.0))
            pushed.insert(b);
    return {pushed.begin(), pushed.end()};
}

void add_constant_forces(const Model& model, const State& state, std::vector<Triple>& forces)
{
    for (const Boundary& boundary : model.boundaries)
    {
        if (!boundary.acts(state.stage) || boundary.forces.empty())
            continue;
        forces.resize(static_cast<std::size_t>(model.blocks()));
        const double factor = factor_of(boundary, model, state);
        for (const BoundaryForce& force : boundary.forces)
        {
            if (state.blocks.present[force.block] == 0)
                continue;
            Triple& on = forces[force.block];
            on = {on.x + factor * force.x, on.y + factor * force.y, on.w + factor * force.moment};
        }
    }
    if (!state.water.empty())
        forces.resize(static_cast<std::size_t>(model.blocks()));
    for (std::size_t b = 0; b < state.water.size(); ++b)
        if (state.blocks.present[b] != 0)
            forces[b] = {forces[b].x + state.water[b].x, forces[b].y + state.water[b].y, forces[b].w + state.water[b].w};
}

std::vector<Triple> constant_forces(const Model& model, const State& state)
{
    std::vector<Triple> forces;
    add_constant_forces(model, state, forces);
    return forces;
}

double work_of(const std::vector<Triple>& given, const std::vector<BlockMotion>& from, const std::vector<BlockMotion>& to)
{
    double work = 0.0;
    for (std::size_t b = 0; b < given.size(); ++b)
        work += given[b].x * (to[b].x - from[b].x) + given[b].y * (to[b].y - from[b].y) +
                given[b].w * (to[b].angle - from[b].angle);
    return work;
}

void add_work_before(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const State& state, EnergyLedger& ledger)
{
    const double half = 0.5 * state.blocks.step.last;
    for (const Index b : pushed)
    {
        const double of_water = state.water.empty() ? 0.0 : half * power(state.water[b], state.blocks.motion[b]);
        ledger.water += of_water;
        ledger.boundary += half * power(forces[b], state.blocks.motion[b]) - of_water;
    }
}

void add_work_after(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const State& state, EnergyLedger& ledger)
{
    const double half = 0.5 * state.blocks.step.next;
    for (const Index b : pushed)
    {
        const double of_water = state.water.empty() ? 0.0 : half * power(state.water[b], state.blocks.motion[b]);
        const double work = half * power(forces[b], state.blocks.motion[b]);
        ledger.water += of_water;
        ledger.boundary += work - of_water;
        ledger.coasting -= work;
    }
}

void book_given_work(const std::vector<Triple>& given, const Model& model, const State& state, const std::vector<BlockMotion>& from,
                     const std::vector<BlockMotion>& to, EnergyLedger& ledger)
{
    const double of_water = work_of(state.water, from, to), constant = work_of(constant_forces(model, state), from, to);
    ledger.water += of_water;
    ledger.boundary += constant - of_water;
    ledger.load_work += work_of(given, from, to) - constant;
}

void book_walls(const std::vector<Index>& walls, const Blocks& blocks, EnergyLedger& ledger)
{
    for (const Index b : walls)
    {
        const BlockForce& force = blocks.force[b];
        const double work = -blocks.step.kick() * power({force.x, force.y, force.moment}, blocks.motion[b]);
        ledger.load_work -= work;
        ledger.boundary += work;
    }
}
}  // namespace hdem
