#pragma once
/// What a file of hdem holds, in words.

#include <filesystem>
#include <string>

namespace hdem
{
/// Lines about a run's folder, a results.h5, a frame, a checkpoint or a case, without reading their arrays. Throws InputError for any other file
/// and for one that is damaged.
/// @see verification/unit/io/results_fuzz_test.cpp
std::string describe_file(const std::filesystem::path& path);
}  // namespace hdem
