#pragma once
/// Fingerprints of a state and of the model it belongs to.

#include "core/model/model.h"
#include "core/state/state.h"

#include <cstdint>

namespace hdem
{
/// XXH3 of every number that decides how a run goes on (state_tables.h), not of counters, the ledger and results of stages. Taken in the user's order of blocks and
/// parts, so that it does not see how blocks and contacts are sorted in memory; -0 counts as 0.
[[nodiscard]] std::uint64_t state_hash(const Model& model, const State& state);

/// XXH3 of shapes, masses, joints and time step, in the user's order of blocks: a state may go on with a model of the same hash only.
[[nodiscard]] std::uint64_t model_hash(const Model& model);
}  // namespace hdem
