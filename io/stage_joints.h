#pragma once
/// `set` of stages: numbers of joints and materials that change at a stage's start.

#include "core/model/case_def.h"
#include "io/case_problems.h"
#include "io/case_source.h"
#include "io/toml_tree.h"

#include <functional>
#include <vector>

namespace hdem
{
/// Reads the document once more into a definition, and checks its joints.
using ReadAgain = std::function<void(TomlNode& document, CaseDef& def, CaseProblems& problems)>;

/// Fill StageDef::joints and materials of each stage with `set`. What an earlier stage has set stays. Changes the document.
/// @return located problems
std::vector<Problem> read_stage_joints(CaseDef& def, TomlNode& document, CaseSource& source, const ReadAgain& read_again);
}  // namespace hdem
