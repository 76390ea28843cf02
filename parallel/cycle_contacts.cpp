/// The first half of a cycle: contacts evaluated, part by part.

#include "core/contact/contact_forces.h"
#include "core/contact/impulse_law.h"
#include "core/detection/contact_tracking.h"
#include "core/motion/step_check.h"
#include "parallel/cycle.h"
#include "parallel/team.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Prefetch the data that contacts of a later part need: processors cannot predict these addresses. `sums`: those to be added to, or none.
void fetch_ahead(const Partition& partition, Index now, Index end, const Blocks& blocks, BlockForce* sums)
{
    constexpr Index own_ahead = 3;
    if (now + own_ahead < end)
    {
        const char* const part = reinterpret_cast<const char*>(&partition.contacts[now + own_ahead]);
        for (std::size_t b = 0; b < sizeof(ContactPart); b += 64)
            __builtin_prefetch(part + b, 1);
    }
    if (now + 1 == end)
        return;
    const IndexRange next = partition.contacts[now + 1].blocks;
    for (Index i = next.begin; i < next.end; ++i)
        __builtin_prefetch(&blocks.motion[partition.blocks_of_contacts[i]]);
    if (sums != nullptr)
        for (Index i = next.begin; i < next.end; ++i)
            __builtin_prefetch(&sums[partition.blocks_of_contacts[i]], 1);
}
}  // namespace

void CycleRunner::evaluate(const Model& model, State& state, const Team& team, double gone, bool is_last, StageClock& clock)
{
    const bool all = !has_loads_ || !left_out_;
    const IndexRange mine = team.share(static_cast<Index>(partition_.contacts.size()));
    const Index own_end = mine.begin < mine.end ? partition_.contacts[mine.end - 1].range.end : 0;
    for (Index i = mine.begin; i < mine.end; ++i)
    {
        ContactPart& part = partition_.contacts[i];
        fetch_ahead(partition_, i, mine.end, state.blocks, sums_run() ? sums_.sums.data() : nullptr);
        const bool whole = all || part.is_whole;  // evaluated in one pass
        part.ledger = {};
        part.searched = 0;
        if (part.tally.stale > 0)
        {
            clock.lap(CycleStage::force);
            part.searched = refresh_features(part.range, model, state.blocks, state.contacts, part.ledger);
            clock.lap(CycleStage::narrow);
        }
        part.tally = {};
        RegimeRule rule = rules_.contact;
        if (rule.closing != Closing::whole_cycles)
            rule.closing = closing_of(part.answer, state.blocks.step.next);
        const PassNeeds needs{.views = !whole || part.searched > 0 || !(gone <= part.seen_until),
                              .rests = !whole || part.searched > 0 || part.rests,
                              .tilts = is_last || rules_.rest.leaves_out,
                              .own_end = own_end};
        // Eqs. (1)-(10), (24)-(28)
        if (sums_run())
        {
            ContactLoads& loads = part_loads_[team.member()];
            loads.first = part.range.begin;
            part.tally = evaluate_contacts(part.range, model, rule, state.blocks, state.contacts, loads, part.tally, needs);
            sums_.add(i, model, state.blocks.present, work_.external, loads, rules_.damping.needs_joint(), work_.loads);
        }
        else if (whole)
            part.tally = evaluate_contacts(part.range, model, rule, state.blocks, state.contacts, work_.loads, part.tally, needs);
        else
            for (const IndexRange& range : part.active)
                part.tally = evaluate_contacts(range, model, rule, state.blocks, state.contacts, work_.loads, part.tally, needs);
        part.rests = !whole || part.tally.unrested;
        if (!whole)
            part.forget();
        else if (needs.views)
            part.remember(gone);
        if (!part.stiff.empty())
            part.unstable = find_unstable(model, state.blocks, state.contacts, part.stiff);
        part.ledger.friction += sum(part.tally.friction);
        part.ledger.contact_changes += sum(part.tally.changes);
        part.ledger.dilation += sum(part.tally.dilation);
        part.ledger.bond_breaking += sum(part.tally.broken);
        part.impulses.clear();
        if (part.tally.impulses > 0)
            collect_impulse_points(part.range, model, state.blocks, state.contacts, part.impulses);
    }
}

void CycleRunner::store_tilts(State& state, const Team& team)
{
    const IndexRange mine = team.share(static_cast<Index>(partition_.contacts.size()));
    for (Index i = mine.begin; i < mine.end && !rules_.rest.leaves_out; ++i)
        store_tilt_forces(partition_.contacts[i].range, state.blocks, state.contacts);
}

void CycleRunner::add_up_contacts(State& state)
{
    state.ledger.contact_changes -= state.ledger.coasting;
    state.ledger.coasting = 0.0;
    for (const ContactPart& part : partition_.contacts)
    {
        state.ledger.add(part.ledger);
        state.feature_searches += part.searched;
        contact_point_updates_ += part.tally.closed;
    }
}
Index CycleRunner::find_unstable_contact() const
{
    for (const ContactPart& part : partition_.contacts)
        if (part.unstable != no_index)
            return part.unstable;
    return no_index;
}

bool CycleRunner::found_deep_overlap() const
{
    return std::ranges::any_of(partition_.contacts, [](const ContactPart& part) { return part.tally.deep > 0; });
}
}  // namespace hdem
