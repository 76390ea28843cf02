#pragma once
/// The other files that a case names: blocks, traces, a profile, pressures, tables of factors.

#include "core/geometry/polygon.h"
#include "io/case_problems.h"
#include "io/case_reader.h"

#include <filesystem>
#include <vector>

namespace hdem
{
/// Read them into the case. Files that cannot be read are `problems`; what is wrong inside a file is `located` already.
/// @param stored  texts kept with the case; nullptr: they lie on the disk, relative names start at the folder of `case_file`
/// @return  the traces of domain.traces_file
[[nodiscard]] std::vector<Polygon> read_named_files(CaseFile& read, const std::filesystem::path& case_file,
                                                    const NamedFiles* stored, CaseProblems& problems,
                                                    std::vector<Problem>& located);
}  // namespace hdem
