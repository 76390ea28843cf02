#include "parallel/partition.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace hdem
{
namespace
{
constexpr Index blocks_a_part = 64;

template <typename Part>
void cut(Index size, Index a_part, std::vector<Part>& parts)
{
    parts.resize(static_cast<std::size_t>((size + a_part - 1) / a_part));
    for (Index i = 0; i < static_cast<Index>(parts.size()); ++i)
    {
        parts[i].range = {i * a_part, std::min(size, (i + 1) * a_part)};
        parts[i].active = {parts[i].range};
    }
}

/// Least colour that no part before has on a movable block of this one. A block with 64 colours takes no more: such parts get colours of their own.
void find_colours(const State& state, Partition& partition)
{
    const Contacts& contacts = state.contacts;
    std::vector<std::uint64_t> taken(static_cast<std::size_t>(state.blocks.size()), 0);
    std::vector<Index> single;
    partition.colours.clear();
    for (Index part = 0; part < static_cast<Index>(partition.contacts.size()); ++part)
    {
        const IndexRange range = partition.contacts[part].range;
        const auto for_movable = [&](const auto& visit)
        {
            for (Index i = range.begin; i < range.end; ++i)
                for (const Index block : {contacts.ref[i], contacts.inc[i]})
                    if (state.blocks.is_free(block))
                        visit(taken[block]);
        };
        std::uint64_t all = 0;
        for_movable([&](std::uint64_t colours) { all |= colours; });
        const int colour = std::countr_one(all);
        if (colour >= 64)
        {
            single.push_back(part);
            continue;
        }
        for_movable([&](std::uint64_t& colours) { colours |= std::uint64_t{1} << colour; });
        if (colour >= static_cast<int>(partition.colours.size()))
            partition.colours.resize(static_cast<std::size_t>(colour) + 1);
        partition.colours[colour].push_back(part);
    }
    for (const Index part : single)
        partition.colours.push_back({part});
}
}  // namespace

void make_partition(const State& state, bool with_colours, Partition& partition)
{
    cut(state.contacts.size(), largest_part, partition.contacts);
    cut(state.blocks.size(), blocks_a_part, partition.blocks);
    partition.colours.clear();
    if (with_colours)
        find_colours(state, partition);
}
}  // namespace hdem
