#pragma once
/// What the command line of `hdem` may say.

#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// Exit codes of every command.
enum ExitCode : int
{
    exit_done = 0,
    exit_run_failed = 1,   ///< non-finite value, overlap too great, disk full
    exit_bad_input = 2,    ///< bad input or usage
    exit_no_convergence = 4
};

struct RunOptions
{
    std::string case_file;
    std::string folder;                       ///< of the results; "" = named after the case
    std::optional<std::string> method;
    std::optional<int> threads;
    std::vector<std::string> overrides;       ///< key.path=value
    bool quiet = false;
    std::vector<std::string> command_line;
};

int run_command(const RunOptions& options);

struct CheckOptions
{
    std::string case_file;
    std::vector<std::string> overrides;
    bool list_blocks = false;
    std::string wkt_file;                     ///< write the blocks there
};
int check_command(const CheckOptions& options);
}  // namespace hdem
