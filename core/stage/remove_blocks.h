#pragma once
/// Blocks that leave the model.

#include "core/model/model.h"
#include "core/state/state.h"

#include <string>

namespace hdem
{
void remove_block(Index block, Blocks& blocks);

/// Remove the blocks of an excavation, or the block of this name. Notes which blocks lay against them, and, where the stage takes forces
/// off slowly, what the removed blocks gave to these. Contacts must be found anew.
void excavate(const Model& model, const std::string& name, State& state);
}  // namespace hdem
