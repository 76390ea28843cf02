#pragma once
/// A case definition as the text of a case file.

#include "core/model/case_def.h"

#include <string>

namespace hdem::verification::rest
{
/// Blocks, materials, joints, gravity, loads, method, damping, step and stages, with all digits: `hdem run` does the same with it to the last bit.
/// What the rest.* scenes leave at its default is not written: a domain, joint sets, excavations, histories and the other settings.
[[nodiscard]] std::string case_text(const CaseDef& def);
}  // namespace hdem::verification::rest
