#include "core/contact/impact_energy.h"

#include "core/contact/impulse_kick.h"

#include <cmath>
#include <unordered_map>

namespace hdem
{
namespace
{
constexpr int halvings = 10;
constexpr double rounding = 1e-9;  ///< share of the work done at the points that counts as no gain

/// Work of the cycle's impulses, and the sum of its amounts [J].
struct Work
{
    double taken = 0.0, amount = 0.0;
};

Work work_of(const std::vector<ImpulsePoint*>& points, const Blocks& blocks)
{
    std::unordered_map<Index, Triple> before;
    for (const ImpulsePoint* p : points)
    {
        const Kick kick(*p, p->impulse_shear, p->pull - p->impulse_normal);
        const auto take_back = [&](Index block, double x, double y, double w)
        {
            const BlockMotion& motion = blocks.motion[block];
            Triple& v = before.try_emplace(block, Triple{motion.vx, motion.vy, motion.w}).first->second;
            change_velocity(blocks.inertia[block], x, y, w, v.x, v.y, v.w);
        };
        take_back(p->ref, kick.x, kick.y, kick.w_ref);
        take_back(p->inc, -kick.x, -kick.y, -kick.w_inc);
    }
    Work work;
    for (const ImpulsePoint* p : points)
    {
        const Triple& ref = before.at(p->ref);
        const Triple& inc = before.at(p->inc);
        const PointVelocity first = relative_velocity(*p, inc.x - ref.x, inc.y - ref.y, ref, inc);
        const PointVelocity last = relative_velocity(*p, blocks.motion[p->ref], blocks.motion[p->inc]);
        const double normal = 0.5 * (p->impulse_normal - p->pull) * (first.m + last.m),
                     shear = -0.5 * p->impulse_shear * (first.t + last.t);
        work.taken += normal + shear;
        work.amount += std::abs(normal) + std::abs(shear);
    }
    return work;
}

bool give_energy(const std::vector<ImpulsePoint*>& points, const Blocks& blocks)
{
    const Work work = work_of(points, blocks);
    return work.taken < -rounding * work.amount;
}
}  // namespace

double energy_taken(const std::vector<ImpulsePoint*>& points, const Blocks& blocks)
{
    return work_of(points, blocks).taken;
}

double restrain_impacts(const std::vector<ImpulsePoint*>& points, const Blocks& blocks, const std::function<double()>& solve)
{
    if (!give_energy(points, blocks))
        return 0.0;
    std::vector<double> parting;
    for (const ImpulsePoint* p : points)
        parting.push_back(p->target);
    double taken = 0.0;
    const auto solve_with = [&](double share)
    {
        for (std::size_t i = 0; i < points.size(); ++i)
            if (parting[i] < 0.0)
                points[i]->target = share * parting[i];
        taken += solve();
    };
    double low = 0.0, high = 1.0;
    for (int k = 0; k < halvings; ++k)
    {
        const double share = 0.5 * (low + high);
        solve_with(share);
        (give_energy(points, blocks) ? high : low) = share;
    }
    solve_with(low);
    return taken;
}
}  // namespace hdem
