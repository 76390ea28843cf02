#pragma once
/// The order in which a model keeps its blocks.

#include "core/model/model.h"

namespace hdem
{
/// Bring the model's blocks, parts and loads into the order in which slot i holds the block `user_number[i]`.
/// @pre  user_number is a permutation of 0 to blocks - 1
void reorder_blocks(const std::vector<Index>& user_number, Model& model);
}  // namespace hdem
