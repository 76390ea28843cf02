#pragma once
/// Runs the stages of a case: so many cycles, so long, or until converged.

#include "core/observer.h"
#include "core/statics/static_result.h"
#include "parallel/simulation.h"

#include <limits>
#include <optional>
#include <span>
#include <string>

namespace hdem
{
/// Looks after a run between pieces of it: saves it, or ends it before its time.
class Keeper
{
  public:
    Keeper() = default;
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;
    virtual ~Keeper() = default;

    /// First cycle after `now` that it wants to see, besides those after every fifth of a second or so.
    [[nodiscard]] virtual std::int64_t next_cycle(std::int64_t now) const = 0;
    /// After a cycle that the observers have seen if they asked for it. True: go on; false: leave the run here.
    [[nodiscard]] virtual bool keep(const Simulation& simulation) = 0;
    /// Within a static solution, which may take long: is the run to be left? keep() comes after it.
    [[nodiscard]] virtual bool is_to_stop() { return false; }
    /// Within a static solution: its iterations until now and the unbalanced ratio of the last one.
    virtual void follow_statics([[maybe_unused]] int iterations, [[maybe_unused]] double ratio) {}
};

struct StageResult
{
    std::string name;
    std::int64_t first_cycle = 0;
    std::int64_t cycles = 0;
    bool sought_rest = false;  ///< it was to end when the rock is at rest
    bool sought_end = false;   ///< or by another end that the case gives
    bool at_rest = false;
    std::int64_t ended_by = ended_by::limit;  ///< which end was met
    double value = 0.0;                       ///< of the quantity of this end
    double time = 0.0;                        ///< of the run, at its end [s]
    std::vector<std::string> to_come;         ///< what still changed when it ended
    /// Has it come to an end that its case gives?
    [[nodiscard]] bool met_end() const { return (!sought_rest && !sought_end) || ended_by != ended_by::limit; }
    std::vector<Index> not_at_rest;  ///< blocks not supported when the stage ended without rest: the user's numbers, ascending
    double wall_seconds = 0.0;       ///< since the start or restart, with what is done when it begins
    std::optional<StaticResult> statics;
};

/// Free blocks that are not supported now: the user's numbers, ascending.
[[nodiscard]] std::vector<Index> blocks_not_at_rest(const Simulation& simulation);

/// Which stages a call runs.
struct StagePart
{
    Index end = std::numeric_limits<Index>::max();  ///< the first that is not run
    const StageResult* over = nullptr;              ///< of the state's stage, where an earlier call has run it to its end
};

/// Run all stages, or those that are left to a state that comes from a checkpoint or from an earlier call, and show the state to the observers. It is
/// checked for non-finite values and overlaps at least every thousand cycles. A stage that the keeper breaks off is the last of the results.
/// However a run is cut into calls its bits are the same.
std::vector<StageResult> run_stages(Simulation& simulation, std::span<Observer* const> observers, Keeper* keeper = nullptr,
                                    const StagePart& part = {});
}  // namespace hdem
