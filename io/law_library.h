#pragma once
/// Joint laws in shared libraries (core/joint/hdem_joint_law.h).

#include "io/case_problems.h"
#include "io/case_reader.h"

#include <filesystem>

namespace hdem
{
/// Load the libraries that joints name. Where one lies and its SHA-256 are kept with the case, so that a restart takes the same.
/// @param read    whose files are kept
/// @param def     whose joints are given their functions
/// @param stored  what was kept; nullptr: relative names start at the folder of `case_file`
void load_laws(CaseFile& read, CaseDef& def, const std::filesystem::path& case_file, const NamedFiles* stored,
               CaseProblems& problems);
}  // namespace hdem
