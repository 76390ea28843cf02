#pragma once
/// Paces of all blocks, from time to time in a stage that looks for rest.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"
#include "parallel/partition.h"

namespace hdem
{
class Team;

/// @param now      number of the cycle
/// @param renewed  the contacts have been found anew in it
/// @pre  all threads of the team are here
void update_paces(const Model& model, State& state, const Team& team, std::int64_t now, bool renewed, Partition& partition,
                  Workspace& work);
}  // namespace hdem
