#pragma once
/// `until` of a [[stage]]: text to an end, and what may be wrong with it.

#include "core/model/stage_end.h"

#include <string>
#include <string_view>

namespace hdem
{
struct ReadStageEnd
{
    StageEndDef end;
    std::string why;  ///< what is wrong; empty: nothing
    std::string remedy;
};

/// "displacement:slab > 0.1", "quiet for 0.5 s". Names are not looked up.
[[nodiscard]] ReadStageEnd read_stage_end(const std::string& text);

/// The page on ends in io/case_format.md.
[[nodiscard]] std::string_view stage_end_page();
}  // namespace hdem
