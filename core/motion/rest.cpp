#include "core/motion/rest.h"

#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Speed below which a block is quiet. A block that is slower at both ends of the checks was, on average, accelerated by less than this speed over half of their time.
double quiet_speed(const RestRule& rule, double step)
{
    return std::min(rule.quiet_speed, 0.5 * stopped * rest_every * step * rule.quiet_on_average);
}

bool is_out_of_balance(Index block, double by, const Model& model, const Blocks& blocks)
{
    return !(unbalance(block, model, blocks) < by) && !(clear_unbalance(block, model, blocks) < by);
}

bool is_quiet(Index block, const Model& model, const RestRule& rule, const Blocks& blocks)
{
    return (blocks.force[block].contacts & contact_impulse) == 0 &&
           rim_speed(block, model, blocks) < quiet_speed(rule, blocks.step.last) &&
           !is_out_of_balance(block, rule.quiet, model, blocks);
}

/// The contacts have counted on its way up to their forces: half a step.
void stop(Index block, const Model& model, Blocks& blocks, EnergyLedger& ledger)
{
    BlockMotion& motion = blocks.motion[block];
    const BlockForce& force = blocks.force[block];
    const Vec2 weight = model.mass[block] * model.gravity;
    ledger.local_damping += kinetic_energy(model, blocks, block) +
                            0.5 * blocks.step.last *
                                ((force.x - weight.x()) * motion.vx + (force.y - weight.y()) * motion.vy + force.moment * motion.w);
    motion.vx = motion.vy = motion.w = 0.0;
}

/// Would evaluating the contact again change nothing? Where a point has slipped it would: of two blocks that have just come to rest, the next evaluation finds
/// the point sticking. (A restart evaluates all contacts.)
bool is_settled(Index contact, const Contacts& contacts, const Blocks& blocks)
{
    constexpr auto slips = static_cast<std::uint8_t>(Regime::slip);
    return contacts.stale[contact] == 0 && contacts.regime[0][contact] != slips && contacts.regime[1][contact] != slips &&
           !blocks.takes_part(contacts.ref[contact]) && !blocks.takes_part(contacts.inc[contact]);
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

bool update_rest(IndexRange range, const Model& model, const RestRule& rule, std::int64_t cycle, Blocks& blocks,
                 EnergyLedger& ledger, std::vector<Index>& woken)
{
    const bool check = cycle % rest_every == 0;
    bool changed = false;
    for (Index b = range.begin; b < range.end; ++b)
    {
        std::uint8_t& rest = blocks.rest[b];
        if (rest < stopped)
        {
            if (!check || !blocks.is_free(b))
                continue;
            rest = is_quiet(b, model, rule, blocks) ? rest + 1 : 0;
            if (rest == stopped)
                stop(b, model, blocks, ledger);
            continue;
        }
        const bool wakes = (blocks.force[b].contacts & contact_impulse) != 0 || is_out_of_balance(b, rule.waking, model, blocks);
        if (wakes)
            woken.push_back(b);
        changed = changed || wakes || rest == stopped;
        rest = wakes ? 0 : left_out;
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

bool all_rest(const Model& model, const RestRule& rule, const std::vector<Index>& taking_part, const Blocks& blocks)
{
    for (Index b = 0; b < blocks.size(); ++b)
        if (blocks.is_free(b) && blocks.takes_part(b) &&
            !(std::ranges::binary_search(taking_part, b) && is_quiet(b, model, rule, blocks)))
            return false;
    return true;
}

bool wake_unbalanced(const Model& model, double limit, Blocks& blocks)
{
    bool woken = false;
    for (Index b = 0; b < blocks.size(); ++b)
        if (blocks.is_free(b) && blocks.rest[b] >= stopped && is_out_of_balance(b, limit, model, blocks))
        {
            blocks.rest[b] = 0;
            woken = true;
        }
    return woken;
}

void find_active_contacts(IndexRange range, const Blocks& blocks, const Contacts& contacts, std::vector<IndexRange>& active)
{
    collect(range, active,
            [&](Index i, Index end)
            {
                for (; i < end; ++i)
                    if (!is_settled(i, contacts, blocks))
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
                    for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
                        if (!is_settled(list.entry[e] / 2, contacts, blocks))
                            return true;
                }
                return false;
            });
}
}  // namespace hdem
