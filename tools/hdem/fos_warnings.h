#pragma once
/// What users must know of the answer of `hdem fos`.

#include "tools/hdem/fos_search.h"

#include <string>
#include <vector>

namespace hdem
{
[[nodiscard]] std::vector<std::string> fos_warnings(const FosOutcome& outcome, const Moment& reference, const State& last);
}  // namespace hdem
