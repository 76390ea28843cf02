#pragma once
/// Commands that are written in Python: hdem plot, hdem report.

#include <string>
#include <vector>

namespace hdem
{
/// Runs the script of hdem COMMAND with these arguments in place of this program: returns only when that is impossible, with an exit code.
int run_script(const std::string& command, const std::string& script, const std::vector<std::string>& arguments);
}  // namespace hdem
