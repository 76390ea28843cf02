#pragma once
/// Do linings still move?

#include "core/model/model.h"
#include "core/state/state.h"

#include <vector>

namespace hdem
{
enum class LinerMotion : std::uint8_t
{
    rests,        ///< its nodes are in balance, or it is not installed
    moves,        ///< it swings, or yields and has not come to an end of it
    has_come_off  ///< it has no rock to hold on any more and falls: nothing catches it
};

struct LinerRest
{
    LinerMotion motion = LinerMotion::rests;
    double unbalanced = 0.0;  ///< see LinerBalance [-]
};

/// Motion of a liner after the last cycle. A liner that has parted from the rock all along but bears what presses on it, as a ring does, rests; a liner at
/// its strength moves.
[[nodiscard]] LinerRest rest_of_liner(const Model& model, const State& state, std::size_t liner);

/// Linings that move, in the order of the case. Those that have come off are not among them: they fall for ever, and nothing waits for them.
[[nodiscard]] std::vector<std::size_t> moving_liners(const Model& model, const State& state);
}  // namespace hdem
