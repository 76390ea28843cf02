#pragma once
/// Looks whether a stage has come to one of the ends that its case gives (`until` of a [[stage]]).
///
/// What an end remembers from one look to the next stands in State::ends, so that a run that goes on from a checkpoint ends in the same cycle.

#include "core/history_sampler.h"
#include "core/model/model.h"
#include "core/state/state.h"

#include <optional>
#include <vector>

namespace hdem
{
/// An end that is met.
struct EndMet
{
    Index end = no_index;  ///< number in StageDef::ends
    double value = 0.0;    ///< of its quantity
};

class StageEnds
{
  public:
    /// Throws InputError for a history that cannot be sampled. @pre names of blocks exist
    StageEnds(const Model& model, Index stage);

    /// The first end of the list that is met now. Each look is remembered.
    /// @param is_settled  ends that rock comes to when it settles count: loads do not change any more
    [[nodiscard]] std::optional<EndMet> look(const Model& model, State& state, bool is_settled);

  private:
    struct End
    {
        StageEndDef def;
        std::vector<Index> blocks;  ///< the user's numbers; empty: all free ones
        std::optional<HistorySampler> history;
    };

    double value_of(End& end, EndWatch& watch, const Model& model, const State& state);

    std::vector<End> ends_;
};
}  // namespace hdem
