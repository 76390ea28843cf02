#pragma once
/// Names and times of a case definition -> blocks and cycles of a model.

#include "core/check.h"
#include "core/model/case_def.h"
#include "core/model/model.h"

namespace hdem
{
/// @pre the reader checked that the material exists
[[nodiscard]] Index material_number(const CaseDef& def, const std::string& name);

/// Fill model.loads, and check that stages, loads and histories name blocks and excavations that exist.
/// @param blocks         at the start
/// @param free_at_times  the same, with those free that a stage frees
/// @return errors, each with the nearest name as a suggestion, and warnings
std::vector<Problem> resolve_names(const CaseDef& def, Model& model, const Blocks& blocks, const Blocks& free_at_times);
}  // namespace hdem
