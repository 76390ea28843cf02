#include "core/contact/block_forces.h"

#include "core/kernels.h"

#include <algorithm>

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

void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, bool find_joint, Blocks& blocks)
{
    kernels().sum_loads(range, model, list, loads, external, find_joint, blocks);
}

void RunningSums::prepare(const std::vector<IndexRange>& shares, Index blocks, const BlockContacts& list)
{
    const auto share_of = [&](Index contact)
    { return std::ranges::upper_bound(shares, contact, {}, &IndexRange::end) - shares.begin(); };
    block_of_.resize(list.entry.size());
    others_.clear();
    starts_.clear();
    sums.resize(static_cast<std::size_t>(blocks));
    for (Index b = 0; b < blocks; ++b)
    {
        const IndexRange mine{list.begin[b], list.begin[b + 1]};
        if (mine.begin < mine.end && share_of(list.entry[mine.begin] / 2) == share_of(list.entry[mine.end - 1] / 2))
        {
            starts_.push_back({list.entry[mine.begin] / 2, b});
            for (Index e = mine.begin; e < mine.end; ++e)
                block_of_[list.entry[e]] = b;
            continue;
        }
        others_.push_back(b);
        for (Index e = mine.begin; e < mine.end; ++e)
            block_of_[list.entry[e]] = no_index;
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
        const Triple weight = weight_of(start->block, model, present, external);
        BlockForce force;
        force.x = weight.x;
        force.y = weight.y;
        force.moment = weight.w;
        force.least_load = least_joint_load(weight);
        sums[start->block] = force;
    }
}

void RunningSums::add(IndexRange range, const ContactLoads& loads, bool find_joint, ContactLoads& kept)
{
    kernels().add_loads(range, loads, find_joint, &block_of_[2 * loads.first], sums.data(), kept);
}
}  // namespace hdem
