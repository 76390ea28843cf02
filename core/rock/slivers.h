#pragma once
/// Small pieces an outline leaves: joined to a neighbour, because the smallest block decides the time step.

#include "core/rock/block_cutter.h"

namespace hdem
{
/// Join every piece cut by an outline and smaller than `smallest_area` to the neighbour on its side of the outlines with which it
/// shares the greatest length, smallest pieces first. Their common edges become internal. A piece without such a neighbour stays,
/// with a warning. Counted in merged_slivers.
void merge_slivers(CutMass& mass, double smallest_area, RockMass& counts);
}  // namespace hdem
