#pragma once
/// What joint sets begin with.

#include "core/rock/block_cutter.h"

namespace hdem
{
/// The domain as one block, or as the cells between its faults, outlines of regions and traces. Warns of what of them was not cut.
CutMass start_mass(const CaseDef& def, const Polygon& domain, RockMass& rock);
}  // namespace hdem
