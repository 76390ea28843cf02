#pragma once
/// Lines that pass a corner by round-off go through it.

#include "core/geometry/polygon.h"

#include <vector>

namespace hdem
{
/// Points of lines that are nearer than `near` to a corner of the domain, or to a point of an earlier line, become that point; lines that pass one so near get it as a
/// point of theirs. Else rock on both sides of a corner would hang together by a neck of this width, or not, as rounding has it. Ends of open lines are no corners:
/// they lie beyond what they meet.
///
/// The time grows with the number of points, and for long lines with the points beside them.
void lead_through_corners(const Polygon& domain, double near, std::vector<Polygon>& lines);
}  // namespace hdem
