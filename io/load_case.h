#pragma once
/// Case file -> model and initial state, in one step.

#include "core/rock/build_model.h"
#include "io/case_reader.h"

namespace hdem
{
struct LoadedCase
{
    CaseFile file;
    Setup setup;
    std::vector<Problem> warnings;  ///< of the reader and of the model, located
};

/// Throws InputError with all problems found, each located in the case file.
LoadedCase load_case(const std::filesystem::path& file, std::span<const Override> overrides = {});
/// The same for a case whose text and other files are in memory; `file` is its name in messages.
LoadedCase load_case(std::string text, const NamedFiles& files, const std::filesystem::path& file,
                     std::span<const Override> overrides);
}  // namespace hdem
