#pragma once
/// Small pieces an outline leaves: joined to a neighbour, because the smallest block decides the time step.

#include "core/rock/block_cutter.h"

#include <map>

namespace hdem
{
/// Join every piece cut by an outline and smaller than `smallest_area` to the neighbour on its side of the outlines with which it
/// shares the greatest length, smallest pieces first. Their common edges become internal. Counted in merged_slivers.
/// Neighbours across joints and traces come first, those across a fault or the outline of a region only where there is no other, with a warning: a piece
/// that reaches through a fault would lock it. A piece without a neighbour stays, with a warning.
/// @param first_joint  edges of joints, traces and cells have sources from this number on; before it come faults and regions
void merge_slivers(CutMass& mass, double smallest_area, std::int32_t first_joint, RockMass& counts);

/// What becomes of the cells between lines of joint sets.
struct SmallCells
{
    double smallest_area = 0.0;             ///< [m2]
    double narrowest = 0.0;                 ///< area over perimeter of the narrowest cell that may stay [m]
    std::int32_t first_source = 0;          ///< cells are joined across edges from this number on: not across faults and outlines
    std::int32_t preferred_source = 0;      ///< those across edges from this number on before all others
    std::map<std::int32_t, double> welded;  ///< length by source along which cells were joined [m]
};

/// Join cells that are smaller or narrower to the neighbour with which they share the greatest length along lines of joint sets.
/// Cells that have none stay.
void merge_cells(CutMass& mass, SmallCells& cells, RockMass& counts);
}  // namespace hdem
