#pragma once
/// What elimination in a given order fills in, found without any tree.

#include "core/statics/block_matrix.h"

#include <set>

namespace hdem::test
{
/// Per place of the order: later places in its column of the factor.
inline std::vector<std::set<Index>> factor_columns(const BlockGraph& graph, const std::vector<Index>& order)
{
    std::vector<Index> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        place[order[i]] = static_cast<Index>(i);
    std::vector<std::set<Index>> column(order.size());
    for (Index i = 0; i < static_cast<Index>(order.size()); ++i)
        for (const Index next : graph.of(order[i]))
            if (place[next] > i)
                column[i].insert(place[next]);
    for (std::set<Index>& each : column)
        if (!each.empty())
        {
            const Index first = *each.begin();
            column[first].insert(std::next(each.begin()), each.end());
        }
    return column;
}

inline Index count_entries(const std::vector<std::set<Index>>& columns)
{
    std::size_t entries = columns.size();
    for (const std::set<Index>& column : columns)
        entries += column.size();
    return static_cast<Index>(entries);
}

inline bool is_permutation(std::vector<Index> order, Index size)
{
    std::sort(order.begin(), order.end());
    for (Index i = 0; i < static_cast<Index>(order.size()); ++i)
        if (order[i] != i)
            return false;
    return static_cast<Index>(order.size()) == size;
}
}  // namespace hdem::test
