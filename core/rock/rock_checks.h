#pragma once
/// Problems of the rock mass's geometry, as the user gave it.

#include "core/check.h"
#include "core/model/case_def.h"

#include <string>
#include <vector>

namespace hdem
{
/// The domain as a polygon, whichever way it was given, in the user's order of vertices; a rectangle begins at its lower left corner
/// and runs anticlockwise, so that its edges are bottom, right, top, left.
Polygon domain_polygon(const DomainDef& domain);

/// Everything wrong with domain, joint sets, generator, excavations and explicit blocks that can be seen before cutting.
std::vector<Problem> find_rock_problems(const CaseDef& def);
}  // namespace hdem
