#pragma once
/// What is worth a word about a rock mass, and what must not happen to it.

#include "core/rock/rock_mass.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// @param joints  of the set that cross the domain
void warn_of_no_joints(const JointSetDef& set, std::size_t number, std::int64_t joints, RockMass& rock);

/// The rock mass would not be the one that was asked for: uncut rock is stronger than any joint.
void warn_of_refused_cuts(const JointSetDef& set, std::size_t number, std::int64_t refused, std::int64_t cuts, RockMass& rock);

/// Cells may be larger than the domain.
void warn_of_large_cells(const CaseDef& def, const Polygon& domain, RockMass& rock);

/// What two excavations share belongs to the first one in the file, and stays until that one is removed.
void warn_of_overlaps(const CaseDef& def, const std::vector<Polygon>& outlines, RockMass& rock);

/// Nothing of the rock may be lost on the way, and no block be without a shape. Throws InputError.
void check_area(const RockMass& rock);

/// The smallest block sets the time step: one far below the rest is worth a word.
void warn_of_small_blocks(const CaseDef& def, RockMass& rock);
}  // namespace hdem
