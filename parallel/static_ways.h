#pragma once
/// Ways to a static solution, each from a trial state that is at rest.

#include "core/state/triple.h"
#include "parallel/static_solver.h"

#include <vector>

namespace hdem
{
struct SearchOutcome : StaticOutcome
{
    bool has_begun_again = false;  ///< a search has thrown blocks out of their places: another way may end elsewhere
};

void add_effort(const StaticOutcome& other, StaticOutcome& outcome);

/// Search for balance, with contacts found anew after each search. The trial is balanced if the outcome is. Blocks that have come away may stand again once: on
/// its way from far out of balance a search throws some out of places where they can stand.
/// @param given  force and moment on each block besides its weight, or empty
SearchOutcome search_balance(const Model& model, State& trial, int threads, const StaticRule& rule,
                             const std::vector<Triple>& given);

/// One search, with all unbalanced forces at once.
SearchOutcome search_at_once(const Model& model, State& trial, int threads, const StaticRule& rule);

/// Release the unbalanced forces at the start, as after a sudden excavation, part by part, from balance to balance.
StaticOutcome search_in_parts(const Model& model, State& trial, int threads, const StaticRule& rule);

/// The same with the forces of excavated blocks, which the stage removes over cycles: their work counts as that of a load.
StaticOutcome take_off_released(const Model& model, State& trial, int threads, const StaticRule& rule);

/// One search, after the rounds of an approach (parallel/static_approach.h).
StaticOutcome approach_and_search(const Model& model, State& trial, int threads, const StaticRule& rule);
}  // namespace hdem
