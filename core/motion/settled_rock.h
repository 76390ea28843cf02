#pragma once
/// Blocks that have moved with the rock around them.

#include "core/model/model.h"
#include "core/state/state.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// For each block: has it moved with what it touches? A chain of blocks that touch, each moved within `distance` of the next one since the start of the run, leads to one that has moved
/// no farther than that.
///
/// So rock that settles under its weight is told from blocks that have fallen: deep rock may settle by more than `distance`, but no block leaves its neighbours.
/// @param distance  [m]
/// @see verification/unit/core/motion/settled_rock_test.cpp
[[nodiscard]] std::vector<std::uint8_t> settled_rock(const Model& model, const State& state, double distance);
}  // namespace hdem
