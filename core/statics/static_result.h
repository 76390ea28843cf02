#pragma once
/// Result of a static solution, for output to users.

#include <string>
#include <vector>

namespace hdem
{
/// What a static solution at the beginning of a stage has found.
struct StaticResult
{
    std::string outcome;
    int iterations = 0;
    double residual = 0.0;           ///< unbalanced force ratio of what stands [-]
    std::vector<std::string> loose;  ///< names of blocks that have come away, or moved when it was given up
};
}  // namespace hdem
