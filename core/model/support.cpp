#include "core/model/support.h"

#include <algorithm>
#include <tuple>

namespace hdem
{
namespace
{
/// Entries of a block in a list that is sorted by blocks. (std::ranges::equal_range gives what clang before 16 cannot compile with this library.)
template <typename Entry>
IndexRange range_of(const std::vector<Entry>& sorted, Index block, Index Entry::*owner)
{
    const auto first = std::ranges::lower_bound(sorted, block, {}, owner), end = std::ranges::upper_bound(sorted, block, {}, owner);
    return {static_cast<Index>(first - sorted.begin()), static_cast<Index>(end - sorted.begin())};
}
}  // namespace

void list_ends(Support& support)
{
    support.ends.clear();
    for (std::size_t b = 0; b < support.bolts.size(); ++b)
        for (std::size_t l = 0; l < support.bolts[b].links.size(); ++l)
        {
            const BoltLink& link = support.bolts[b].links[l];
            const auto bolt = static_cast<Index>(b), at = static_cast<Index>(l);
            support.ends.push_back({link.first, bolt, at, true});
            support.ends.push_back({link.second, bolt, at, false});
        }
    std::ranges::sort(support.ends, {}, [](const BoltEnd& e) { return std::tuple(e.block, e.bolt, e.link, e.is_first); });
    support.ties.clear();
    for (std::size_t i = 0; i < support.liners.size(); ++i)
        for (std::size_t s = 0; s < support.liners[i].segments.size(); ++s)
            for (int end = 0; end < 2; ++end)
                if (const Index block = support.liners[i].segments[s].block; block != no_index)
                    support.ties.push_back({block, static_cast<Index>(i), static_cast<Index>(s), end});
    std::ranges::sort(support.ties, {}, [](const LinerTie& t) { return std::tuple(t.block, t.liner, t.segment, t.end); });
}

IndexRange ties_of(const Support& support, Index block)
{
    return range_of(support.ties, block, &LinerTie::block);
}

bool is_held(const Support& support, Index block)
{
    return ends_of(support, block).size() > 0 || ties_of(support, block).size() > 0;
}

IndexRange ends_of(const Support& support, Index block)
{
    return range_of(support.ends, block, &BoltEnd::block);
}
}  // namespace hdem
