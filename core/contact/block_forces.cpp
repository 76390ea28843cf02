#include "core/contact/block_forces.h"

#include "core/simd.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace hdem
{
void list_block_contacts(const Contacts& contacts, Index blocks, BlockContacts& list)
{
    list.begin.assign(static_cast<std::size_t>(blocks) + 1, 0);
    list.entry.resize(2 * static_cast<std::size_t>(contacts.size()));
    for (Index i = 0; i < contacts.size(); ++i)
    {
        ++list.begin[contacts.ref[i] + 1];
        ++list.begin[contacts.inc[i] + 1];
    }
    for (Index b = 0; b < blocks; ++b)
        list.begin[b + 1] += list.begin[b];
    std::vector<Index> at(list.begin.begin(), list.begin.end() - 1);
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index swapped = contacts.swapped[i];
        list.entry[at[contacts.ref[i]]++] = 2 * i + swapped;
        list.entry[at[contacts.inc[i]]++] = 2 * i + 1 - swapped;
    }
}

namespace
{
/// Weight and external forces of a block.
Pack weight_of(Index b, const Model& model, const std::vector<std::uint8_t>& present, const std::vector<Triple>& external)
{
    const double mass = present[b] != 0 ? model.mass[b] : 0.0;
    Pack sum(Pack::V{mass * model.gravity.x(), mass * model.gravity.y(), 0.0, 0.0});
    if (!external.empty())
        sum += Pack(Pack::V{external[b].x, external[b].y, external[b].w, 0.0});
    return sum;
}

using Words = std::uint32_t __attribute__((vector_size(16)));

/// Add a load to a block's `sum` and its other numbers. Without branches, but for joints that are in use alike: which joint of a block is in use most nobody can predict.
template <bool find_joint>
[[gnu::always_inline]] inline void add_load(const BlockLoad& load, const JointUse& use, Pack& sum, BlockForce& force)
{
    sum += Pack::load(&load.x);
    if constexpr (!find_joint)
    {
        force.contacts |= use.contacts;
        return;
    }
    const double squared = load.x * load.x + load.y * load.y;
    // Two joints that slide have both all of their strength in use: the one that bears more counts, whichever stands first.
    const bool is_more = use.mobilised > force.mobilised || (use.mobilised == force.mobilised && squared > force.joint_load);
    Words of_use, of_force;  // mobilised, t_x, t_y, contacts
    std::memcpy(&of_use, &use, sizeof of_use);
    std::memcpy(&of_force, &force.mobilised, sizeof of_force);
    const std::uint32_t taken = is_more ? ~0U : 0U;
    const Words mask{taken, taken, taken, 0};
    const Words contacts = of_use & Words{0, 0, 0, ~0U};
    of_force = (of_use & mask) | (of_force & ~mask) | contacts;
    std::memcpy(&force.mobilised, &of_force, sizeof of_force);
    force.joint_load = is_more ? squared : force.joint_load;
}
static_assert(offsetof(JointUse, contacts) == 12 && offsetof(BlockForce, contacts) == offsetof(BlockForce, mobilised) + 12);

template <bool find_joint>
void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, Blocks& blocks)
{
    for (Index b = range.begin; b < range.end; ++b)
    {
        Pack sum = weight_of(b, model, blocks.present, external);
        BlockForce force;
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
        {
            const Index entry = list.entry[e];
            add_load<find_joint>(loads.load[entry], loads.use[entry / 2], sum, force);
        }
        sum.store(&force.x);
        blocks.force[b] = force;
    }
}

}  // namespace

void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, bool find_joint, Blocks& blocks)
{
    if (find_joint)
        sum_forces<true>(range, model, list, loads, external, blocks);
    else
        sum_forces<false>(range, model, list, loads, external, blocks);
}

void RunningSums::prepare(const std::vector<IndexRange>& shares, Index blocks, const BlockContacts& list)
{
    const auto share_of = [&](Index contact)
    { return std::ranges::upper_bound(shares, contact, {}, &IndexRange::end) - shares.begin(); };
    is_kept_.assign(list.entry.size(), 0);
    others_.clear();
    starts_.clear();
    sums.resize(static_cast<std::size_t>(blocks));
    for (Index b = 0; b < blocks; ++b)
    {
        const IndexRange mine{list.begin[b], list.begin[b + 1]};
        if (mine.begin < mine.end && share_of(list.entry[mine.begin] / 2) == share_of(list.entry[mine.end - 1] / 2))
        {
            starts_.push_back({list.entry[mine.begin] / 2, b});
            continue;
        }
        others_.push_back(b);
        for (Index e = mine.begin; e < mine.end; ++e)
            is_kept_[list.entry[e]] = 1;
    }
    std::ranges::stable_sort(starts_, {}, &Start::contact);
}

std::vector<Index> RunningSums::others(IndexRange range) const
{
    return {std::ranges::lower_bound(others_, range.begin), std::ranges::lower_bound(others_, range.end)};
}

void RunningSums::begin(IndexRange range, const Model& model, const std::vector<std::uint8_t>& present,
                        const std::vector<Triple>& external)
{
    for (auto start = std::ranges::lower_bound(starts_, range.begin, {}, &Start::contact);
         start != starts_.end() && start->contact < range.end; ++start)
    {
        BlockForce force;
        weight_of(start->block, model, present, external).store(&force.x);
        sums[start->block] = force;
    }
}

template <bool find_joint>
void RunningSums::add(IndexRange range, const Contacts& contacts, const ContactLoads& loads, ContactLoads& kept)
{
    const auto add_side = [&](Index i, int side, Index block)
    {
        const Index at = i - loads.first;
        if (is_kept_[2 * i + side] != 0)
        {
            kept.load[2 * i + side] = loads.load[2 * at + side];
            kept.use[i] = loads.use[at];
            return;
        }
        BlockForce& force = sums[block];
        Pack sum = Pack::load(&force.x);
        add_load<find_joint>(loads.load[2 * at + side], loads.use[at], sum, force);
        sum.store(&force.x);
    };
    for (Index i = range.begin; i < range.end; ++i)
    {
        const bool swapped = contacts.swapped[i] != 0;
        add_side(i, 0, swapped ? contacts.inc[i] : contacts.ref[i]);
        add_side(i, 1, swapped ? contacts.ref[i] : contacts.inc[i]);
    }
}

void RunningSums::add(IndexRange range, const Contacts& contacts, const ContactLoads& loads, bool find_joint, ContactLoads& kept)
{
    if (find_joint)
        add<true>(range, contacts, loads, kept);
    else
        add<false>(range, contacts, loads, kept);
}
}  // namespace hdem
