#pragma once
/// Commands that are written in Python: hdem plot, hdem report, hdem view.

#include <filesystem>
#include <string>
#include <vector>

namespace hdem
{
/// The distribution's, for which python3-h5py and python3-matplotlib are packaged; the first python3 of PATH may be another.
inline constexpr const char* python = "/usr/bin/python3";

/// PREFIX/bin/hdem finds PREFIX/share/hdem, installed or in a build folder.
std::filesystem::path shared_folder();

/// Runs the script of hdem COMMAND with these arguments in place of this program: returns only when that is impossible, with an exit code.
int run_script(const std::string& command, const std::string& script, const std::vector<std::string>& arguments);
}  // namespace hdem
