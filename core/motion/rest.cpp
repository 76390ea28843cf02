#include "core/motion/rest.h"

#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double quiet_speeds = 0.2;    // of mean_speed
constexpr double quiet_cycles = 256.0;  // in which it will not become faster
constexpr double quiet_ratios = 0.05;   // of unbalanced_force_ratio
constexpr double waking_limits = 10.0;  // of what is quiet

/// Net force and moment as an acceleration of the rim [m/s2].
double unbalance(Index block, const Model& model, const Blocks& blocks)
{
    const BlockForce& f = blocks.force[block];
    return (std::sqrt(f.x * f.x + f.y * f.y) + std::abs(f.moment) / model.radius[block]) / model.mass[block];
}

bool is_quiet(Index block, const Model& model, const RestLimits& limits, const Blocks& blocks)
{
    const double speed = blocks.velocity(block).norm() +
                         std::abs(blocks.motion[block].w) / blocks.pace[block] * model.radius[block];
    return speed < limits.speed && unbalance(block, model, blocks) < limits.acceleration;
}

void stop(Index block, const Model& model, Blocks& blocks, EnergyLedger& ledger)
{
    ledger.local_damping += kinetic_energy(model, blocks, block);
    BlockMotion& motion = blocks.motion[block];
    motion.vx = motion.vy = motion.w = 0.0;
}

/// Put the groups for which `is_active(first, end)` holds together.
template <typename IsActive>
void collect(IndexRange range, std::vector<IndexRange>& active, const IsActive& is_active)
{
    active.clear();
    for (Index i = range.begin; i < range.end; i += lanes)
    {
        const Index end = std::min(range.end, i + lanes);
        if (!is_active(i, end))
            continue;
        if (!active.empty() && active.back().end == i)
            active.back().end = end;
        else
            active.push_back({i, end});
    }
}
}  // namespace

RestLimits rest_limits(const Model& model)
{
    const std::vector<std::string>& criteria = model.convergence.criteria;
    const bool by_force = std::find(criteria.begin(), criteria.end(), "unbalanced_force_ratio") != criteria.end();
    const double speed = quiet_speeds * model.convergence.mean_speed;
    const double acceleration = speed / (quiet_cycles * model.time_step);
    const double most = quiet_ratios * model.convergence.unbalanced_force_ratio * model.gravity.norm();
    return {.speed = speed, .acceleration = by_force ? std::min(acceleration, most) : acceleration};
}

bool update_rest(IndexRange range, const Model& model, const RestLimits& limits, bool check, Blocks& blocks, EnergyLedger& ledger)
{
    bool changed = false;
    for (Index b = range.begin; b < range.end; ++b)
    {
        std::uint8_t& rest = blocks.rest[b];
        if (rest < stopped)
        {
            if (!check || !blocks.is_free(b))
                continue;
            const bool quiet = (blocks.force[b].contacts & contact_impulse) == 0 && is_quiet(b, model, limits, blocks);
            rest = quiet ? rest + 1 : 0;
            if (rest == stopped)
                stop(b, model, blocks, ledger);
            continue;
        }
        const bool woken = (blocks.force[b].contacts & contact_impulse) != 0 ||
                           !(unbalance(b, model, blocks) < waking_limits * limits.acceleration);
        changed = changed || woken || rest == stopped;
        rest = woken ? 0 : left_out;
    }
    return changed;
}

bool is_beside_moving(Index block, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks)
{
    for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
        if (blocks.takes_part(contacts.ref[list.entry[e] / 2]) || blocks.takes_part(contacts.inc[list.entry[e] / 2]))
            return true;
    return false;
}

void wake_all(Blocks& blocks)
{
    std::fill(blocks.rest.begin(), blocks.rest.end(), std::uint8_t{0});
}

void find_active_contacts(IndexRange range, const Blocks& blocks, const Contacts& contacts, std::vector<IndexRange>& active)
{
    collect(range, active,
            [&](Index i, Index end)
            {
                for (; i < end; ++i)
                    if (contacts.stale[i] != 0 || blocks.takes_part(contacts.ref[i]) || blocks.takes_part(contacts.inc[i]))
                        return true;
                return false;
            });
}

void find_active_blocks(IndexRange range, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks,
                        std::vector<IndexRange>& active)
{
    collect(range, active,
            [&](Index b, Index end)
            {
                for (; b < end; ++b)
                {
                    if (blocks.takes_part(b))
                        return true;
                    if (is_beside_moving(b, list, contacts, blocks))
                        return true;
                }
                return false;
            });
}
}  // namespace hdem
