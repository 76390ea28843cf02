#pragma once
/// summary.json: the outcome of a run in one small file.

#include "core/energy_ledger.h"
#include "core/statics/static_result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
struct StageSummary
{
    std::string name;
    std::int64_t cycles = 0;
    bool sought_rest = false;              ///< key until_converged: it was to end when the rock is at rest
    bool at_rest = false;                  ///< key converged
    std::vector<std::string> not_at_rest;  ///< names of blocks that were not supported when it ended without rest
    double wall_seconds = 0.0;             ///< since the start or restart [s]
    std::optional<StaticResult> statics;   ///< key static_solution
};

/// Wall time of one stage of the cycles, over the threads.
struct StageTiming
{
    std::string name;
    double least = 0.0;  ///< [s]
    double mean = 0.0;
    double greatest = 0.0;
    double share = 0.0;  ///< of the mean in the time of all cycles and their output
};

/// Fields are written under their own names, in this order. SI units. A number that is not finite becomes null.
struct RunSummary
{
    std::string case_name;  ///< key "case": name of the case file
    std::string title;
    std::string method;  ///< force, impulse or hybrid
    int threads = 1;
    std::string version;  ///< of hdem
    std::string git_commit;
    std::int64_t blocks = 0;  ///< at the end, without excavated ones
    std::int64_t free_blocks = 0;
    std::int64_t contact_points = 0;   ///< closed ones, at the end
    double time_step = 0.0;            ///< [s]
    double paper_time_step = 0.0;      ///< Eq. (32) [s]
    double smallest_block_mass = 0.0;  ///< of the free blocks [kg per m]
    std::int64_t cycles = 0;
    double time = 0.0;                                    ///< simulated [s]
    bool converged = false;                               ///< every stage that was to converge did
    std::optional<std::int64_t> cycles_after_excavation;  ///< null without an excavation
    std::vector<StageSummary> stages;
    double kinetic_energy = 0.0;        ///< [J]
    double kinetic_energy_limit = 0.0;  ///< below it the criterion kinetic_energy holds [J]
    double unbalanced_force_ratio = 0.0;
    double mean_displacement =
        0.0;  ///< of blocks next to the excavation, without detached ones; without an excavation as the next two [m]
    double max_displacement = 0.0;             ///< [m]
    double mean_displacement_all = 0.0;        ///< of all free blocks [m]
    double max_displacement_all = 0.0;         ///< [m]
    std::vector<std::string> detached_blocks;  ///< names
    std::vector<std::string> lost_blocks;      ///< names of blocks that have left the model and are held
    EnergyLedger energy;                       ///< sums since the start [J]
    StoredEnergy stored;                       ///< at the end [J]
    double wall_seconds = 0.0;
    double contact_point_updates_per_second = 0.0;
    std::vector<StageTiming> timing;    ///< since the start or the last restart; key per stage with min, mean, max, share
    std::uint64_t state_hash = 0;       ///< written as 16 hexadecimal digits
    std::vector<std::string> warnings;  ///< of the case and of the run
};

std::string summary_text(const RunSummary& summary);
void write_summary(const std::filesystem::path& file, const RunSummary& summary);
}  // namespace hdem
