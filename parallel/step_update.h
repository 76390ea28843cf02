#pragma once
/// The step of the next cycle, in stages in which it varies.

#include "core/model/model.h"
#include "core/motion/step_control.h"
#include "core/state/state.h"
#include "core/state/workspace.h"
#include "parallel/partition.h"

namespace hdem
{
class Team;

/// @param now      number of the cycle
/// @param renewed  contacts have been found anew in it
/// @pre  all threads of the team are here
void update_step(const Model& model, const StepRule& rule, State& state, const Team& team, std::int64_t now, bool renewed,
                 Partition& partition, const BlockContacts& list);
}  // namespace hdem
