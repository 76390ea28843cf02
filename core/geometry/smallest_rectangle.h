#pragma once
/// The smallest rectangle around points, whichever way it is turned.

#include "core/types.h"

#include <vector>

namespace hdem
{
/// Collects points and keeps their convex hull, so that a million blocks take no more memory than one.
class SmallestRectangle
{
  public:
    void add(const std::vector<Vec2>& points);

    /// Area of the smallest rectangle around all points [m2]; one of its sides lies along an edge of their hull
    /// (Freeman and Shapira 1975). 0 for points on a line. The same for the same points in a turned frame, but for round-off.
    [[nodiscard]] double area();

  private:
    void keep_hull();

    std::vector<Vec2> points_;  ///< the hull of what was added, and what was added since
    std::size_t hull_size_ = 0;
};
}  // namespace hdem
