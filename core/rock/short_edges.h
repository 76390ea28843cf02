#pragma once
/// Short edges of cells between lines, where a line ends or bends just beside another one.

#include "core/rock/slivers.h"

namespace hdem
{
/// Join cells with an edge shorter than `smallest` to a neighbour, so that the edge becomes part of a longer one: the neighbour's edge goes
/// straight on from it. Of two such neighbours the one with the shorter common edge is taken. Nothing is joined across edges below
/// cells.first_source. Counted in merged_slivers; lengths go to cells.welded.
/// @return number of short edges that are left
std::int64_t join_at_short_edges(CutMass& mass, double smallest, SmallCells& cells, RockMass& counts);
}  // namespace hdem
