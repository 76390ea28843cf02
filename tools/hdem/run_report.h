#pragma once
/// What a run says about itself at its beginning and at its end.

#include "core/stress/insitu_stress.h"
#include "io/summary.h"
#include "parallel/stages.h"
#include "tools/hdem/run_start.h"
#include "tools/hdem/screen.h"

namespace hdem
{
/// Times since this program began, or since it went on from a checkpoint.
struct Session
{
    std::int64_t first_cycle = 0;
    double seconds = 0.0;         ///< in cycles
    double cpu_seconds = 0.0;     ///< likewise, over all threads
    double output_seconds = 0.0;  ///< of `seconds`, for rows, files and checkpoints
};

/// Processor time of this program, over all threads [s].
[[nodiscard]] double cpu_seconds();

/// Traces, cuts and what became of them, in one line.
[[nodiscard]] std::string describe_cuts(const RockMass& rock);

/// A line for each joint set, the Voronoi cells and the traces of a file: what was drawn, and the share that was dropped.
[[nodiscard]] std::vector<std::string> describe_sets(const RockMass& rock);

void print_banner(Log& log, const RunStart& start, const RunOptions& options, Simulation& simulation);

/// @param wall_seconds of the whole run, over all restarts
RunSummary summarise(const RunStart& start, const Simulation& simulation, const std::vector<StageResult>& stages,
                     const Session& session, double wall_seconds);

/// What a user must know of a run that came to its end.
[[nodiscard]] std::vector<std::string> run_warnings(const Simulation& simulation, const RunSummary& summary);

void print_closing(Log& log, const RunSummary& summary, const Session& session, const Simulation& simulation,
                   const std::filesystem::path& folder);
/// Why a run would not begin in equilibrium, if so.
std::vector<std::string> insitu_warnings(const Model& model, const InsituSummary& insitu);
}  // namespace hdem
