#pragma once
/// From the bolts of a case to those of a model.

#include "core/check.h"
#include "core/model/case_def.h"
#include "core/model/model.h"
#include "core/state/support_state.h"

#include <vector>

namespace hdem
{
/// Finds the blocks that bolts are tied to and what they cross, as drawn, without the blocks that are excavated by the time of their stage; divides by their spacing.
/// @pre  `blocks` are as drawn; the keys are checked (io/case_checks_support.cpp)
[[nodiscard]] std::vector<Problem> resolve_support(const CaseDef& def, const Blocks& blocks, Model& model, SupportState& state);
}  // namespace hdem
