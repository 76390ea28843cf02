#include "core/model/support.h"

#include <algorithm>
#include <tuple>

namespace hdem
{
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
}

IndexRange ends_of(const Support& support, Index block)
{
    const auto found = std::ranges::equal_range(support.ends, block, {}, &BoltEnd::block);
    return {static_cast<Index>(found.begin() - support.ends.begin()), static_cast<Index>(found.end() - support.ends.begin())};
}
}  // namespace hdem
