#pragma once
/// What the command line of `hdem` may say.

#include "parallel/team.h"
#include "parallel/thread_choice.h"

#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// Exit codes of every command.
enum ExitCode : int
{
    exit_done = 0,
    exit_run_failed = 1,  ///< non-finite value, overlap too great, disk full
    exit_bad_input = 2,   ///< bad input or usage
    exit_no_convergence = 4,
    exit_wall_time = 5  ///< --max-wall was over; 129, 130, 143 and 152: interrupted by SIGHUP, SIGINT, SIGTERM and SIGXCPU
};

/// Option --threads: a number, or nothing for auto.
[[nodiscard]] inline ThreadRule thread_rule(const std::optional<int>& number)
{
    return number ? ThreadRule(*number) : ThreadRule(default_threads(), ThreadRule::Kind::measured);
}

struct RunOptions
{
    std::string case_file;           ///< "" = that of the checkpoint
    std::string folder;              ///< of the results; "" = named after the case, or that of the checkpoint
    std::string restart;             ///< checkpoint, or folder with one; "" = a new run
    bool overwrite = false;          ///< begin anew where a run was cut short
    bool live = false;               ///< write a page that follows the run
    std::optional<double> max_wall;  ///< [s]
    std::optional<std::string> method;
    std::optional<int> threads;
    std::vector<std::string> overrides;  ///< key.path=value
    bool quiet = false;
    bool is_of_search = false;  ///< the run of hdem fos, whose factor of safety the summary may hold
    std::vector<std::string> command_line;
};

int run_command(const RunOptions& options);

struct FosOptions
{
    RunOptions run;
};
int fos_command(const FosOptions& options);

struct CriticalOptions
{
    std::string case_file;
    std::string vary;    ///< KEY=LOW:HIGH
    std::string fails;   ///< displacement:BLOCK>0.1, detached>0
    std::string folder;  ///< of the results; "" = the case's name with _critical
    std::optional<double> tolerance;
    std::optional<int> threads;
    std::vector<std::string> overrides;
    bool overwrite = false;
    bool quiet = false;
};
int critical_command(const CriticalOptions& options);

struct CheckOptions
{
    std::string case_file;
    std::vector<std::string> overrides;
    std::string blocks_file;  ///< for all blocks, "" = none
    bool list_blocks = false;
};
int check_command(const CheckOptions& options);
}  // namespace hdem
