#pragma once
/// Hilbert curve: a number for a point, such that points with near numbers lie near each other.

#include "core/geometry/polygon.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace hdem
{
/// Position along the Hilbert curve of order 31 through the square [0, 2^31)^2.
[[nodiscard]] inline std::uint64_t hilbert_number(std::uint32_t x, std::uint32_t y)
{
    std::uint64_t number = 0;
    for (std::uint32_t side = 1u << 30; side > 0; side >>= 1)
    {
        const std::uint32_t right = (x & side) != 0 ? 1 : 0;
        const std::uint32_t upper = (y & side) != 0 ? 1 : 0;
        number += static_cast<std::uint64_t>(side) * side * ((3 * right) ^ upper);
        if (upper == 0)
        {
            if (right == 1)
            {
                x = ~x;
                y = ~y;
            }
            std::swap(x, y);
        }
    }
    return number;
}

/// Numbers of the points in their order along the curve through a square around `box`; of equal ones the first comes first.
/// @pre all points lie in the box
[[nodiscard]] inline std::vector<Index> curve_order(const std::vector<Vec2>& points, const Box& box)
{
    const double side = std::max((box.high - box.low).maxCoeff(), 1e-300);
    std::vector<std::uint64_t> number(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Vec2 at = (points[i] - box.low) / side * 2147483647.0;
        number[i] = hilbert_number(static_cast<std::uint32_t>(std::clamp(at.x(), 0.0, 2147483647.0)),
                                   static_cast<std::uint32_t>(std::clamp(at.y(), 0.0, 2147483647.0)));
    }
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return number[a] != number[b] ? number[a] < number[b] : a < b; });
    return order;
}
}  // namespace hdem
