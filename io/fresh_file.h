#pragma once
/// Files opened so that nobody else's file is written: not through a link, a pipe or a name that somebody has guessed.

#include <cstdio>
#include <filesystem>

namespace hdem
{
/// A name beside FILE that nobody guesses: FILE.xxxxxxxxxxxx.tmp, twelve random hexadecimal digits.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& file);

/// A new file, open for writing; an error when the name is taken (O_EXCL). Returns the descriptor, or -1 with errno.
[[nodiscard]] int open_new(const std::filesystem::path& file);

/// FILE opened for text behind what it has, or as a new file in its place. A link or a pipe of this name is not followed: it is replaced by
/// a new file, and refused for appending. Null with errno.
[[nodiscard]] std::FILE* open_log(const std::filesystem::path& file, bool append);

/// Remove what killed runs have left under temporary_name() in a folder. Only who holds the folder's lock may do so.
void remove_leftovers(const std::filesystem::path& folder);
}  // namespace hdem
