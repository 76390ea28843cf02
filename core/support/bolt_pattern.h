#pragma once
/// Bolts around an excavation.

#include "core/model/support_def.h"

#include <vector>

namespace hdem
{
/// A bolt's head and end in the user's coordinates.
struct BoltLine
{
    Vec2 from = {0.0, 0.0};  ///< [m]
    Vec2 to = {0.0, 0.0};
};

/// The outline, anticlockwise, or those stretches of it that lie within the arc, as seen from the middle of its box [deg]. Without an arc the last point is the first one.
[[nodiscard]] std::vector<Polygon> stretches_of(const Polygon& outline, const std::optional<Vec2>& arc);

/// Lines of `pattern.length` with their heads on the outline, square to it. A stretch of the outline within the pattern's arc is cut into equal pieces no longer than
/// `along`; a head stands in the middle of each.
[[nodiscard]] std::vector<BoltLine> bolts_around(const Polygon& outline, const BoltDef& pattern);
}  // namespace hdem
