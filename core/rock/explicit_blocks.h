#pragma once
/// Blocks given by their polygons.

#include "core/rock/rock_mass.h"

namespace hdem
{
/// Add every [[block]] of the definition, in convex parts, after the blocks that are there. Blocks may touch; throws InputError when one
/// overlaps another block by more than a millionth of the smaller one's area, or has a name that is taken.
/// @pre the polygons are simple (find_rock_problems)
void add_explicit_blocks(const CaseDef& def, RockMass& rock);
}  // namespace hdem
