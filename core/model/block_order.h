#pragma once
/// The order in which a model keeps its blocks.

#include "core/model/model.h"

#include <utility>

namespace hdem
{
/// Values in the order of `from`: entry i is that of from[i].
template <typename T>
void permute(const std::vector<Index>& from, std::vector<T>& values)
{
    std::vector<T> permuted;
    permuted.reserve(values.size());
    for (const Index i : from)
        permuted.push_back(std::move(values[i]));
    values = std::move(permuted);
}

/// Bring the model's blocks, parts and loads into the order in which slot i holds the block `user_number[i]`.
/// @pre  user_number is a permutation of 0 to blocks - 1
void reorder_blocks(const std::vector<Index>& user_number, Model& model);
}  // namespace hdem
