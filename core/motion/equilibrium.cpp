#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
double kinetic_energy(const Model& model, const Blocks& blocks, Index block)
{
    const BlockMotion& motion = blocks.motion[block];
    const double pace = blocks.pace[block];
    return (0.5 * model.mass[block] * (motion.vx * motion.vx + motion.vy * motion.vy) +
            0.5 * model.inertia[block] * motion.w * motion.w) /
           (pace * pace);
}

void add_equilibrium(IndexRange range, const Model& model, const State& state, ConvergenceBlocks which, Equilibrium& sums)
{
    const Blocks& blocks = state.blocks;
    std::vector<Vec2> applied(static_cast<std::size_t>(range.size()));
    for (Index i = range.begin; i < range.end; ++i)
        applied[i - range.begin] = model.mass[i] * model.gravity;
    for (const Load& load : model.loads)
        if (load.from < state.cycle && state.cycle <= load.until)  // acted in the cycle before
            for (const Index i : load.blocks)
                if (i >= range.begin && i < range.end)
                    applied[i - range.begin] += model.mass[i] * load.acceleration + load.force;
    const bool only_standing = which == ConvergenceBlocks::standing;
    for (Index i = range.begin; i < range.end; ++i)
    {
        if (!blocks.is_free(i) || (only_standing && blocks.is_loose(i, model.convergence.loose_distance)))
            continue;
        const BlockInertia& inertia = blocks.inertia[i];
        const BlockForce& force = blocks.force[i];
        sums.kinetic_energy += kinetic_energy(model, blocks, i);
        sums.unbalanced_force +=
            Vec2(inertia.inverse_mass_x > 0.0 ? force.x : 0.0, inertia.inverse_mass_y > 0.0 ? force.y : 0.0).norm();
        sums.applied_force += applied[i - range.begin].norm();
        sums.free_mass += model.mass[i];
        sums.greatest_speed = std::max(sums.greatest_speed, blocks.velocity(i).norm());
    }
}

DisplacementReport report_displacements(const Model& model, const State& state)
{
    const Blocks& blocks = state.blocks;
    DisplacementReport report;
    Index counted_all = 0;
    const bool excavated = !state.next_to_excavation.empty();
    std::vector<std::uint8_t> near(static_cast<std::size_t>(blocks.size()), excavated ? 0 : 1);
    for (const Index i : state.next_to_excavation)
        near[i] = 1;
    for (const Index i : model.slot_of_user)
    {
        if (!blocks.is_free(i))
            continue;
        const double distance = blocks.displacement(i).norm();
        if (distance > model.convergence.detached_distance)
        {
            report.detached.push_back(i);
            continue;
        }
        report.mean_all += distance;
        report.greatest_all = std::max(report.greatest_all, distance);
        ++counted_all;
        if (near[i] == 0)
            continue;
        report.mean += distance;
        report.greatest = std::max(report.greatest, distance);
        ++report.counted;
    }
    report.mean = report.counted > 0 ? report.mean / report.counted : 0.0;
    report.mean_all = counted_all > 0 ? report.mean_all / counted_all : 0.0;
    return report;
}
}  // namespace hdem
