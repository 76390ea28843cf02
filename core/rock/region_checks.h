#pragma once
/// What is wrong with faults and regions a user gave.

#include "core/check.h"
#include "core/model/case_def.h"

#include <vector>

namespace hdem
{
/// @pre the domain is simple
std::vector<Problem> find_region_problems(const CaseDef& def);
}  // namespace hdem
