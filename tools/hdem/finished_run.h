#pragma once
/// A case that has run in this program.

#include "core/observer.h"
#include "tools/hdem/options.h"
#include "tools/hdem/run_report.h"

#include <memory>
#include <vector>

namespace hdem
{
struct FinishedRun
{
    RunStart start;  ///< its model and state have gone to the simulation
    std::unique_ptr<Simulation> simulation{};
    std::unique_ptr<Log> log{};
    std::vector<StageResult> stages{};
    RunSummary summary{};
    int exit_code = exit_done;
    bool is_complete = false;  ///< all stages have run; else it was broken off
};

/// All stages into the folder of the results, with checkpoints, as `hdem run`.
/// @param also  sees the states too
FinishedRun run_case(const RunOptions& options, Observer* also = nullptr);
}  // namespace hdem
