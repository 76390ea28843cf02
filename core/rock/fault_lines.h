#pragma once
/// Faults and outlines of regions as lines that are cut into the domain, and the side of a fault as an area.

#include "core/model/case_def.h"

#include <vector>

namespace hdem
{
/// Lines nearer to each other than this lie on each other, and ends are made longer by it [m].
double line_slack(const Polygon& domain);

/// Faults in their order, then outlines of regions. What lies on the domain's boundary or on an earlier line parts nothing more and is
/// left out; open ends are made longer by line_slack, so that they meet what they end at.
/// @pre find_rock_problems has none
std::vector<SourceLine> source_lines(const CaseDef& def);

/// The area above a fault as far as the domain reaches: on the left of its points, taken in the direction of growing x. Its ends go on
/// straight. Not simple where the fault winds so that this has no meaning.
/// @pre at least two points, the last not straight above or below the first
Polygon area_above(const FaultDef& fault, const Polygon& domain);

/// Do the first and the last point say which side is above?
bool has_above(const FaultDef& fault);
}  // namespace hdem
