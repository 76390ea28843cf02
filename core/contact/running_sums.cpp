#include "core/contact/running_sums.h"

#include "core/check.h"
#include "core/kernels.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace hdem
{
namespace
{
using Numbered = std::pair<Index, std::uint8_t>;  ///< block, number

/// Both blocks of each contact of `part`, by blocks.
void list_by_blocks(IndexRange part, const Contacts& contacts, std::vector<Numbered>& all)
{
    all.clear();
    for (Index i = part.begin; i < part.end; ++i)
    {
        const auto number = static_cast<std::uint8_t>(2 * (i - part.begin));
        const std::uint8_t swapped = contacts.swapped[i];
        all.emplace_back(contacts.ref[i], number + swapped);
        all.emplace_back(contacts.inc[i], number + 1 - swapped);
    }
    std::ranges::sort(all);
}

/// Numbers of one block in Numbered.
struct Stretch
{
    bool continues;
    std::size_t first, count;
};
}  // namespace

void RunningSums::find_others(const std::vector<IndexRange>& parts, const std::vector<IndexRange>& shares,
                              const BlockContacts& list)
{
    std::vector<Index> ends;  // of shares, in contacts
    for (const IndexRange& share : shares)
        if (share.begin < share.end)
            ends.push_back(parts[share.end - 1].end);
    const auto share_of = [&](Index entry) { return std::ranges::upper_bound(ends, entry / 2) - ends.begin(); };
    const std::size_t blocks = list.begin.size() - 1;
    others_.clear();
    is_other_.assign(blocks, 0);
    for (Index b = 0; b < static_cast<Index>(blocks); ++b)
    {
        const IndexRange own{list.begin[b], list.begin[b + 1]};
        if (own.begin < own.end && share_of(list.entry[own.begin]) == share_of(list.entry[own.end - 1]))
            continue;
        is_other_[b] = 1;
        others_.push_back(b);
    }
}

void RunningSums::prepare(const std::vector<IndexRange>& parts, const std::vector<IndexRange>& shares, const Contacts& contacts,
                          const BlockContacts& list)
{
    find_others(parts, shares, list);
    sums.resize(is_other_.size());
    parts_.resize(parts.size());
    std::vector<Numbered> all;
    std::vector<Stretch> stretches;
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
        HDEM_EXPECT(parts[p].size() <= most_contacts);
        PartEntries& part = parts_[p];
        part = {};
        list_by_blocks(parts[p], contacts, all);
        stretches.clear();
        for (std::size_t first = 0, end = 0; first < all.size(); first = end)
        {
            const Index block = all[first].first;
            for (end = first; end < all.size() && all[end].first == block; ++end)
                if (is_other_[block] != 0)
                    part.kept.push_back(all[end].second);
            if (is_other_[block] == 0)
                stretches.push_back({list.entry[list.begin[block]] / 2 < parts[p].begin, first, end - first});
        }
        // Those of one length together: a processor can predict how often the loop over them is passed.
        std::ranges::stable_sort(stretches, {}, [](const Stretch& s) { return std::tie(s.continues, s.count); });
        for (const Stretch& s : stretches)
        {
            (s.continues ? part.continued : part.begun).push_back({all[s.first].first, static_cast<Index>(s.count)});
            for (std::size_t k = s.first; k < s.first + s.count; ++k)
                part.numbers.push_back(all[k].second);
        }
    }
}

std::vector<Index> RunningSums::others(IndexRange range) const
{
    return {std::ranges::lower_bound(others_, range.begin), std::ranges::lower_bound(others_, range.end)};
}

void RunningSums::add(Index part, const Model& model, const std::vector<std::uint8_t>& present, const std::vector<Triple>& external,
                      const ContactLoads& loads, bool find_joint, ContactLoads& kept)
{
    kernels().add_loads(parts_[part], model, present, external, loads, find_joint, sums.data(), kept);
}
}  // namespace hdem
