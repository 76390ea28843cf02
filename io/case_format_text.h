#pragma once
/// What io/case_format.md says besides the tables of keys.

#include <string_view>

namespace hdem::format_text
{
extern const std::string_view introduction;
extern const std::string_view example;    ///< a whole case
extern const std::string_view semantics;  ///< what the words mean, and the files that a case names
}  // namespace hdem::format_text
