#pragma once
/// The state of rest that the trials of a strength reduction begin from.

#include "core/observer.h"
#include "parallel/stages.h"
#include "parallel/strength_trial.h"

#include <functional>
#include <optional>
#include <vector>

namespace hdem
{
/// Keeps the moment before the last stage of a run.
class BeforeLastStage : public Observer
{
  public:
    [[nodiscard]] std::int64_t next_cycle(std::int64_t) const override { return never; }
    void observe(const Model& model, const State& state) override;
    void end_stage(const Model& model, const State& state) override;
    [[nodiscard]] const std::optional<Moment>& moment() const { return moment_; }

  private:
    std::optional<Moment> moment_;
};

struct Reference
{
    Moment moment;
    std::vector<Index> gave_way{};  ///< blocks that did not stand in the last stage by their own strength, the user's numbers
    bool is_anew = false;           ///< that stage was run anew because of them
};

/// The last stage of a run.
struct LastStage
{
    bool found_rest = true;   ///< it ended at rest, or did not look for it
    double least_area = 0.0;  ///< smaller blocks may fall [m2]
    /// The moment before it; asked for only where blocks moved far in it. Not given: it is not run anew.
    std::function<std::optional<Moment>()> before = {};
};

/// Blocks that did not stand in the last stage, whatever its strain: they moved farther than a fifth of their size in it, or the stage looked for rest and did not find
/// it while they moved. The user's numbers, ascending.
[[nodiscard]] std::vector<Index> blocks_that_gave_way(const Moment& last, bool found_rest, double least_area);

/// The last state, brought to rest under a thousand times its strength. Where blocks gave way in the last stage it is run anew from its
/// beginning under that strength: F belongs to where these blocks stood, not to where they lie.
///
/// Blocks that moved by more than convergence.detached_distance or 0.02 of their size, but go less than half as far under that strength, gave way, too.
/// The others are soft rock that settles.
[[nodiscard]] Reference find_reference(const Moment& last, const LastStage& stage, const ThreadRule& threads);
}  // namespace hdem
