#pragma once
/// hdem plot: hands over to plot.py.

#include <string>
#include <vector>

namespace hdem
{
/// Runs plot.py with these arguments in place of this program: returns only when that is impossible, with an exit code.
int run_plot(const std::vector<std::string>& arguments);
}  // namespace hdem
