#pragma once
/// The state of rest that the trials of a strength reduction begin from.

#include "core/observer.h"
#include "parallel/stages.h"
#include "parallel/strength_trial.h"

#include <optional>

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
    std::vector<Index>
        gave_way{};  ///< blocks that did not stand in the last stage by their own strength, the user's numbers: it was run anew
};

/// Blocks that did not stand in the last stage: they moved farther than `far` of their size in it, or the stage looked for rest and did not find it while they
/// moved. The user's numbers, ascending.
[[nodiscard]] std::vector<Index> blocks_that_gave_way(const Moment& last, bool found_rest, double least_area, double far = 0.2);

/// The last state, brought to rest under a thousand times its strength. Where blocks gave way in the last stage it is run anew from its
/// beginning under that strength: what F asks is where these blocks stood, not where they lie.
/// @param before  the last stage; not needed where nothing gave way
[[nodiscard]] Reference find_reference(const Moment& last, const std::vector<Index>& gave_way, const std::optional<Moment>& before,
                                       const ThreadRule& threads);
}  // namespace hdem
