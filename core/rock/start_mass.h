#pragma once
/// The rock before joint sets cut it.

#include "core/rock/block_cutter.h"

namespace hdem
{
/// The domain as one block, or as the cells between its faults, outlines of regions and traces. Warns of parts of these lines that were not cut.
CutMass start_mass(const CaseDef& def, const Polygon& domain, RockMass& rock);
}  // namespace hdem
