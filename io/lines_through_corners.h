#pragma once
/// Makes lines that miss a corner only by round-off go through it.

#include "core/geometry/polygon.h"

#include <vector>

namespace hdem
{
/// Points of lines that are nearer than `near` to a corner of the domain, or to a point of an earlier line, become that point; a line that passes such a
/// point within `near` gets it as one of its own.
/// Else round-off would decide whether rock on both sides of a corner hangs together by a neck of this width. Ends of open lines are no corners:
/// they lie beyond what they meet.
///
/// The time grows with the number of points, and for long lines with the points beside them.
void lead_through_corners(const Polygon& domain, double near, std::vector<Polygon>& lines);
}  // namespace hdem
