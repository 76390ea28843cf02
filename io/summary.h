#pragma once
/// summary.json: the outcome of a run in one small file.

#include "core/energy_ledger.h"
#include "core/model/trace_cells.h"
#include "core/statics/static_result.h"

#include <array>
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
    bool sought_end = false;               ///< it was to end by another end that the case gives
    bool met_end = true;                   ///< it has come to an end that the case gives
    std::string ended_by;  ///< "cycles", "duration", "max_cycles", "converged", "at rest", or the end as the case says it
    std::optional<double> end_value;   ///< of the quantity of this end
    double end_time = 0.0;             ///< of the run [s]
    std::vector<std::string> to_come;  ///< what still changed when it ended
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

/// How many threads cycles ran on, since the start or the last restart; key thread_use.
struct ThreadSummary
{
    struct Change
    {
        std::int64_t cycle = 0;
        int threads = 1;
    };
    bool fixed = true;            ///< key rule: "fixed" or "auto"
    std::vector<double> share;    ///< of the cycles, by the number of threads; key share_of_cycles, without zeros
    std::vector<Change> changes;  ///< first cycle and number, from then on chosen ones; the first thousand
    std::int64_t trials = 0;      ///< of other numbers
};

/// A bolt at the end. Forces are those of one bolt, energies those of a metre of thickness.
struct BoltSummary
{
    std::string name;
    std::string kind;
    std::string status;           ///< planned, elastic, slips, yielded, ruptured, lost
    Vec2 from = {0.0, 0.0};       ///< where its head is now; local: of the first piece that works [m]
    Vec2 to = {0.0, 0.0};         ///< [m]
    double axial_force = 0.0;     ///< greatest along it [N]
    double across_force = 0.0;    ///< [N]
    double greatest_force = 0.0;  ///< axial, so far [N]
    double elongation = 0.0;      ///< since it was installed [m]
    double stored = 0.0;          ///< [J]
    double spent = 0.0;           ///< [J]
};
[[nodiscard]] std::vector<BoltSummary> summarise_bolts(const Model& model, const State& state);

/// A segment of a liner at the end, of a metre out of plane.
struct LinerPiece
{
    Vec2 from = {0.0, 0.0};          ///< where it is now [m]
    Vec2 to = {0.0, 0.0};            ///< [m]
    double thrust = 0.0;             ///< compression positive [N]
    double shear = 0.0;              ///< [N]
    std::array<double, 2> moment{};  ///< at its ends; positive: its inside is stretched [N m]
};
struct LinerSummary
{
    std::string name;
    bool installed = false;
    double thrust = 0.0;        ///< greatest [N]
    double moment = 0.0;        ///< greatest, without sign [N m]
    double displacement = 0.0;  ///< greatest since it was installed [m]
    std::int64_t hinges = 0;    ///< nodes that have turned plastically
    double parted = 0.0;        ///< length that has come off the rock [m]
    double stored = 0.0;        ///< [J]
    double spent = 0.0;         ///< [J]
    double unbalanced = 0.0;    ///< share of its loads that is not borne [-]
    bool is_off = false;        ///< it has come off the rock along all of its length, and falls
    bool moves = false;         ///< it hangs on the rock or bears, and is not in balance
    bool is_far = false;        ///< it has moved by more than its thickness: its theory takes displacements as small
    std::vector<LinerPiece> segments;
};
[[nodiscard]] std::vector<LinerSummary> summarise_liners(const Model& model, const State& state);

/// Fields are written under their own names, in this order. SI units. A number that is not finite becomes null.
struct RunSummary
{
    std::string case_name;  ///< key "case": name of the case file
    std::string title;
    std::string method;  ///< force, impulse or hybrid
    int threads = 1;     ///< at most
    ThreadSummary thread_use;
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
    bool converged = false;                               ///< every stage that was to come to rest did
    bool met_ends = false;                                ///< every stage met an end of its `until`: not max_cycles first
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
    std::vector<std::string> detached_blocks;  ///< names, in the last stage
    std::vector<std::string> detached_before;  ///< names of others, in earlier ones
    std::vector<std::string> lost_blocks;      ///< names of blocks that have left the model and are held
    std::vector<BoltSummary> bolts;
    std::vector<LinerSummary> liners;
    std::vector<DrawnSet> joint_sets;  ///< as drawn
    EnergyLedger energy;               ///< sums since the start [J]
    StoredEnergy stored;               ///< at the end [J]
    double wall_seconds = 0.0;
    double contact_point_updates_per_second = 0.0;
    std::vector<StageTiming> timing;    ///< since the start or the last restart; key per stage with min, mean, max, share
    std::uint64_t state_hash = 0;       ///< written as 16 hexadecimal digits
    std::vector<std::string> warnings;  ///< of the case and of the run
};

std::string summary_text(const RunSummary& summary);
void write_summary(const std::filesystem::path& file, const RunSummary& summary);
}  // namespace hdem
