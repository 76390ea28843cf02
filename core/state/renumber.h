#pragma once
/// Rows that name a block, once blocks have other numbers.

#include "core/types.h"

#include <algorithm>
#include <vector>

namespace hdem
{
/// @param number  new one of each block
/// @param rows  ascending by `block`, then again
template <typename Row>
void renumber(const std::vector<Index>& number, std::vector<Row>& rows)
{
    for (Row& row : rows)
        row.block = number[row.block];
    std::ranges::sort(rows, {}, &Row::block);
}
}  // namespace hdem
