#pragma once
/// [[boundary]] of a case -> sides of the model.

#include "core/check.h"
#include "core/model/model.h"
#include "core/rock/rock_mass.h"
#include "core/state/blocks.h"

#include <vector>

namespace hdem
{
/// Fill model.boundaries, and bring walls and fixed sides of the first stage into the blocks. Walls of later stages come later.
/// Tractions on rock that nothing holds are a problem: it would move as a whole.
/// @param rock    whose blocks are in the user's order
/// @param origin  of the model in the coordinates of the blocks of `rock`
/// @pre the model has its blocks and its in-situ stress; `blocks` their places and what the case fixes
[[nodiscard]] std::vector<Problem> resolve_boundaries(const CaseDef& def, const RockMass& rock, const Vec2& origin, Model& model,
                                                      Blocks& blocks);

/// The blocks, with those free that a fixed side does not hold in all stages. The time step must be stable for free ones, too.
[[nodiscard]] Blocks with_freed_sides(const Model& model, Blocks blocks);

/// Does the boundary act in the stage of this name?
[[nodiscard]] bool acts_in(const BoundaryDef& def, const std::string& stage);

/// Law of the contacts of walls: springs of the default joint that bear no shear.
[[nodiscard]] CoulombSlip law_of_walls(const CoulombSlip& standard);
}  // namespace hdem
