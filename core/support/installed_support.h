#pragma once
/// Which bolts and liners stand, and where bolts are installed.

#include "core/model/model.h"
#include "core/state/state.h"

#include <vector>

namespace hdem
{
/// Has any bolt or liner been installed?
[[nodiscard]] bool has_support(const SupportState& support);

/// Blocks of all bolts and liners that have been installed, ascending: these blocks never rest. Those that act no more count too, so that the answer does not depend
/// on when a run was restarted.
[[nodiscard]] std::vector<Index> bolted_blocks(const Model& model, const State& state);

/// Install the bolts of the stage that has begun, at the present places of the blocks.
/// @return  whether there are any
bool install_bolts(const Model& model, State& state);
}  // namespace hdem
