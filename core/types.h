#pragma once
/// Words every file of hdem shares: vectors, indices, ranges. SI units everywhere, unit thickness out of plane.

#include <Eigen/Core>

#include <cstdint>
#include <numbers>
#include <vector>

namespace hdem
{
using Vec2 = Eigen::Vector2d;

/// Vertices in order, not repeated at the end [m].
using Polygon = std::vector<Vec2>;

/// Position in an array of blocks, parts, vertices or contacts.
using Index = std::int32_t;
inline constexpr Index no_index = -1;

/// Half-open range [begin, end) of positions in an array; what a stage of the cycle is handed.
struct IndexRange
{
    Index begin = 0;
    Index end = 0;

    [[nodiscard]] Index size() const { return end - begin; }
};

/// z component of a x b.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

/// a turned by +90 degrees.
[[nodiscard]] inline Vec2 turned_left(const Vec2& a)
{
    return {-a.y(), a.x()};
}

[[nodiscard]] inline constexpr double radians(double degrees)
{
    return degrees * (std::numbers::pi / 180.0);
}
}  // namespace hdem
