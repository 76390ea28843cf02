#pragma once
/// Case file -> CaseDef. Everything that is wrong is reported at once, each problem with file, line and column.

#include "core/model/case_def.h"
#include "io/case_override.h"
#include "io/case_source.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hdem
{
/// Larger case files are refused before they are read: many blocks belong into blocks_file.
inline constexpr std::size_t largest_case_file = 16'000'000;  // bytes
/// Largest size of the files that a case names; a checkpoint holds them as one text.
inline constexpr std::size_t largest_named_file = 1'000'000'000;  // bytes

/// Texts of the other files that a case names, each under the name that the case gives it.
using NamedFiles = std::map<std::string, std::string>;

struct CaseFile
{
    CaseDef def;
    NamedFiles files;               ///< blocks_file, traces_file
    CaseSource source;              ///< finds file:line:col of problems that are noticed later
    std::vector<Problem> warnings;  ///< located
};

/// Reads the case, the overrides and the blocks_file, and checks them. Throws InputError whose problems are located:
/// their texts begin with file:line:col. Problems found later by others have keys only: print source.located(problem).
CaseFile read_case_file(const std::filesystem::path& file, std::span<const Override> overrides = {});

/// The same for a text that is already in memory.
/// @param file  its name in messages; blocks_file is looked up beside it,
/// @param files or here, when given
CaseFile read_case_text(std::string text, const std::filesystem::path& file, std::span<const Override> overrides = {},
                        const NamedFiles* files = nullptr);

CaseDef read_case(const std::filesystem::path& file, std::span<const Override> overrides = {});
}  // namespace hdem
