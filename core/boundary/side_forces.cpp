#include "core/boundary/side_forces.h"

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
    return {face.block, sum.x(), sum.y(), cross(face.body_from, at_from) + cross(face.body_to, at_to)};
}

void add_constant_forces(const Model& model, const State& state, std::vector<Triple>& forces)
{
    for (const Boundary& boundary : model.boundaries)
    {
        if (!boundary.acts(state.stage) || boundary.forces.empty())
            continue;
        forces.resize(static_cast<std::size_t>(model.blocks()));
        for (const BoundaryForce& force : boundary.forces)
        {
            if (state.blocks.present[force.block] == 0)
                continue;
            Triple& on = forces[force.block];
            on = {on.x + force.x, on.y + force.y, on.w + force.moment};
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

void add_work_before(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const Blocks& blocks,
                     EnergyLedger& ledger)
{
    for (const Index b : pushed)
        ledger.load_work += 0.5 * blocks.step.last * power(forces[b], blocks.motion[b]);
}

void add_work_after(const std::vector<Index>& pushed, const std::vector<Triple>& forces, const Blocks& blocks, EnergyLedger& ledger)
{
    for (const Index b : pushed)
    {
        const double work = 0.5 * blocks.step.next * power(forces[b], blocks.motion[b]);
        ledger.load_work += work;
        ledger.coasting -= work;
    }
}
}  // namespace hdem
