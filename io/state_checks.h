#pragma once
/// Can a state from a file be run? The cycle trusts what it is given, so whoever reads a state checks it first.

#include "core/model/model.h"
#include "core/state/state.h"

#include <optional>
#include <string>
#include <vector>

namespace hdem
{
struct Damage
{
    std::string object;  ///< of the checkpoint
    std::string reason;
};

/// Each number from 0 to n - 1 once?
[[nodiscard]] bool is_permutation(const std::vector<Index>& order);

/// The first thing that could make a cycle read beyond an array, or that no run leaves behind. Arrays have their sizes already; values of
/// forces and places are judged by being finite only.
[[nodiscard]] std::optional<Damage> find_damage(const Model& model, const State& state);
}  // namespace hdem
