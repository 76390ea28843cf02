#include "core/motion/equilibrium.h"

#include "core/boundary/side_forces.h"
#include "core/motion/loads.h"
#include "core/motion/settled_rock.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
double kinetic_energy(const Model& model, const Blocks& blocks, Index block)
{
    const BlockMotion& motion = blocks.motion[block];
    return 0.5 * model.mass[block] * (motion.vx * motion.vx + motion.vy * motion.vy) +
           0.5 * model.inertia[block] * motion.w * motion.w;
}

namespace
{
/// Of the components that can move [N].
double net_force(Index block, const Blocks& blocks)
{
    const BlockInertia& inertia = blocks.inertia[block];
    const BlockForce& force = blocks.force[block];
    return Vec2(inertia.inverse_mass_x > 0.0 ? force.x : 0.0, inertia.inverse_mass_y > 0.0 ? force.y : 0.0).norm();
}

double unbalance_with(double net_force, Index block, const Model& model, const Blocks& blocks)
{
    const double moment = blocks.inertia[block].inverse_inertia > 0.0 ? std::abs(blocks.force[block].moment) : 0.0;
    return (net_force + moment / model.radius[block]) / model.mass[block];
}

/// Can unbalance_with exceed this? Without its two divisions; in doubt yes.
bool may_be_unbalanced_more(double than, double net_force, Index block, const Model& model, const Blocks& blocks)
{
    constexpr double rounding = 1.0 - 1e-12;
    const double radius = model.radius[block];
    return !(net_force * radius + std::abs(blocks.force[block].moment) <= rounding * (than * model.mass[block] * radius));
}
}  // namespace

double unbalance(Index block, const Model& model, const Blocks& blocks)
{
    return unbalance_with(net_force(block, blocks), block, model, blocks);
}

double clear_unbalance(Index block, const Model& model, const Blocks& blocks)
{
    const BlockMotion& motion = blocks.motion[block];
    const double found = unbalance(block, model, blocks), radius = model.radius[block];
    const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * model.greatest_stiffness * 2.0 * radius *
                            (std::abs(motion.x) + std::abs(motion.y) + radius) / model.mass[block];
    const double at_rest = model.convergence.block_unbalanced_ratio *
                           (model.gravity.isZero(0.0) ? earth_gravity : model.gravity.norm());
    return rounding > 0.01 * at_rest ? std::max(found - std::min(rounding, 10.0 * at_rest), 0.0) : found;
}

namespace
{
double rim_speed_at(double speed, Index block, const Model& model, const Blocks& blocks)
{
    return speed + std::abs(blocks.motion[block].w) * model.radius[block];
}
}  // namespace

double rim_speed(Index block, const Model& model, const Blocks& blocks)
{
    return rim_speed_at(blocks.velocity(block).norm(), block, model, blocks);
}

namespace
{
/// A sum of forces on a block [N].
struct ForceSum
{
    Vec2 sum = Vec2::Zero();
    double sizes = 0.0;  ///< of each force by itself

    void add(const Vec2& force)
    {
        sum += force;
        sizes += force.norm();
    }
    /// What is left of forces that cancel each other is round-off: it is no scale for anything.
    [[nodiscard]] Vec2 net() const
    {
        constexpr double round_off = 1e-12;
        return sum.norm() > round_off * sizes ? sum : Vec2(Vec2::Zero());
    }
};

/// Loads on each block of `range` that acted in the last cycle [N]; empty without any. Tractions on sides count only without gravity: they are part of the stress in the rock, beside which
/// its weight is small.
std::vector<ForceSum> loads_on(IndexRange range, const Model& model, const State& state)
{
    std::vector<ForceSum> loads;
    if (!model.loads.empty() || (model.gravity.isZero() && !model.boundaries.empty()))
        loads.resize(static_cast<std::size_t>(range.size()));
    for (const Load& load : model.loads)
        if (const double factor = last_factor_of(load, model, state); factor != 0.0)
            for (const Index i : load.blocks)
                if (i >= range.begin && i < range.end)
                    loads[i - range.begin].add(factor * (model.mass[i] * load.acceleration + load.force));
    if (model.gravity.isZero())
        for (const Boundary& boundary : model.boundaries)
            for (const BoundaryForce& force : boundary.forces)
                if (boundary.acts(state.stage) && force.block >= range.begin && force.block < range.end)
                    loads[force.block - range.begin].add(factor_of(boundary, model, state) * Vec2(force.x, force.y));
    return loads;
}
}  // namespace

void add_equilibrium(IndexRange range, const Model& model, const State& state, ConvergenceBlocks which, Equilibrium& sums)
{
    const Blocks& blocks = state.blocks;
    std::vector<ForceSum> loads = loads_on(range, model, state);
    const double gravity = model.gravity.norm();
    const bool only_standing = which == ConvergenceBlocks::standing;
    for (Index i = range.begin; i < range.end; ++i)
    {
        if (!blocks.is_free(i) || (only_standing && blocks.is_loose(i, model.convergence.loose_distance)))
            continue;
        double greatest = gravity;
        Vec2 applied = model.mass[i] * model.gravity;
        if (!loads.empty())
        {
            ForceSum& loaded = loads[i - range.begin];
            greatest = std::max(greatest, loaded.net().norm() / model.mass[i]);
            loaded.add(applied);
            applied = loaded.net();
        }
        const double scale = greatest > 0.0 ? greatest : earth_gravity;
        sums.kinetic_energy += kinetic_energy(model, blocks, i);
        const double net = net_force(i, blocks);
        sums.unbalanced_force += net;
        sums.applied_force += applied.norm();
        sums.free_mass += model.mass[i];
        const double speed = blocks.velocity(i).norm();
        sums.greatest_speed = std::max(sums.greatest_speed, speed);
        if (sums.unbalanced.block == no_index ||
            may_be_unbalanced_more(scale * sums.unbalanced.value, net, i, model, blocks))  // the clear one is no greater
            sums.unbalanced.add(clear_unbalance(i, model, blocks) / scale, i);
        sums.fastest.add(rim_speed_at(speed, i, model, blocks), i);
    }
}

bool holds(const ConvergenceDef& criteria, const Equilibrium& now)
{
    const auto meets = [&](const std::string& criterion)
    {
        if (criterion == "kinetic_energy")
            return now.kinetic_energy < now.kinetic_energy_at(criteria.mean_speed);
        if (criterion == "unbalanced_force_ratio")
            return now.unbalanced_force_ratio() < criteria.unbalanced_force_ratio;
        return now.unbalanced.value < criteria.block_unbalanced_ratio && now.fastest.value < criteria.mean_speed;
    };
    const bool nothing_is_free = now.free_mass == 0.0;
    return !criteria.criteria.empty() && (nothing_is_free || std::ranges::all_of(criteria.criteria, meets));
}

bool is_supported(Index block, const Model& model, const State& state)
{
    Equilibrium alone;
    add_equilibrium({block, block + 1}, model, state, ConvergenceBlocks::all, alone);
    ConvergenceDef criterion = model.convergence;
    criterion.criteria = {"every_block"};
    return holds(criterion, alone);
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
        if (!blocks.is_free(i) && !has_left(i, model, blocks))
            continue;
        const double distance = blocks.displacement(i).norm();
        const bool detached = distance > model.convergence.detached_distance;
        const Vec2 now(blocks.motion[i].x, blocks.motion[i].y);
        if (detached)
            report.detached.push_back(i);
        else if ((now - model.start[i]).norm() > model.convergence.detached_distance)
            report.before.push_back(i);
        report.mean_all += distance;
        report.greatest_all = std::max(report.greatest_all, distance);
        ++counted_all;
        if (near[i] == 0 || (excavated && detached))
            continue;
        report.mean += distance;
        report.greatest = std::max(report.greatest, distance);
        ++report.counted;
    }
    if (!report.before.empty())
    {
        const std::vector<std::uint8_t> settled = settled_rock(model, state, model.convergence.detached_distance);
        std::erase_if(report.before, [&](Index i) { return settled[i] != 0; });
    }
    report.mean = report.counted > 0 ? report.mean / report.counted : 0.0;
    report.mean_all = counted_all > 0 ? report.mean_all / counted_all : 0.0;
    return report;
}

bool has_left(Index block, const Model& model, const Blocks& blocks)
{
    const BlockMotion& motion = blocks.motion[block];
    return blocks.present[block] != 0 && model.is_far_outside({motion.x, motion.y});
}
}  // namespace hdem
