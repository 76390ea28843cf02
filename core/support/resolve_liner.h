#pragma once
/// [[liner]] as nodes, and segments with the blocks behind them.

#include "core/model/model.h"

#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// What a liner is made from.
struct LinerPlan
{
    const LinerDef* def = nullptr;
    Index stage = 0;
    std::vector<Polygon> stretches;                   ///< in the user's coordinates, with the rock on their right-hand side
    const std::vector<std::uint8_t>* gone = nullptr;  ///< per block: it is not there any more in its stage
};

/// Greatest distance of its nodes [m]. Ties act at nodes. A point load P on a beam on ties of K_N bends it over the length
///
///   1 / beta = (4 E I / K_N)^(1/4)
///
/// and displacement and moment are too small by a quarter of (beta h)^2 at nodes h apart: 0.6 % at the default, h = 0.15 / beta, but no more than two thicknesses.
[[nodiscard]] double longest_segment(const LinerDef& def);

/// Make a liner. Its nodes stand where the block behind it changes, at corners, and no farther apart than `segment`. A stretch whose ends are one point is
/// closed there.
/// @return  nothing where no block lies behind any of it
[[nodiscard]] std::optional<Liner> resolve_liner(const LinerPlan& plan, const Blocks& blocks, const Model& model);
}  // namespace hdem
