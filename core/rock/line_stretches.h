#pragma once
/// Where along a straight line a joint may be: in the domain, in the regions of its set, on its side of faults.

#include "core/rock/regions.h"

#include <vector>

namespace hdem
{
/// A part of a straight line, with what lies outside the domain.
struct Stretch
{
    Vec2 from = {0.0, 0.0};  ///< [m]
    Vec2 to = {0.0, 0.0};    ///< [m]
    double length = 0.0;     ///< in the domain [m]
};

/// Shares of the way from `from` to `to` at which an open or closed line is met, in no order.
void add_crossings(const Polygon& line, bool is_closed, const Vec2& from, const Vec2& to, std::vector<double>& shares);

/// [m]
[[nodiscard]] double length_inside(const Polygon& domain, const Vec2& from, const Vec2& to);

/// Parts of the line that are left by the set's regions and by the faults at which it stops, seen from its middle. Cut ends are made longer by line_slack.
[[nodiscard]] std::vector<Stretch> find_stretches(const CaseDef& def, const Regions& regions, const JointSetDef& set,
                                                  const Polygon& domain, const Vec2& from, const Vec2& to);
}  // namespace hdem
