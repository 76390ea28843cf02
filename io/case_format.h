#pragma once
/// The case file's documentation and JSON Schema, written from the table in io/case_schema*.cpp.

#include <string>
#include <string_view>

namespace hdem
{
/// The page io/case_format.md; a test compares the file with this text.
std::string case_format_markdown();

/// JSON Schema (draft-07) of a case file, for editors and for checks outside hdem. It knows types, ranges and choices;
/// what needs more than one key (case_checks.h) only hdem knows.
std::string case_json_schema();

/// A small complete case that runs in seconds.
std::string_view case_example();
}  // namespace hdem
