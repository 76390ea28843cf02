#include "perf/bare_wall.h"

#include <algorithm>
#include <cmath>

namespace hdem::perf
{
namespace
{
constexpr double step_share = 0.2;  ///< of the least period of a brick on its springs, about
}

BareWall::BareWall(Index side)
    : gravity(9.81 * std::min(1.0, 100.0 / side)),
      step(step_share * std::sqrt(mass / (12.0 * normal_stiffness)))
{
    for (Index i = 0; i < side * side; ++i)
    {
        const Index course = i / side;
        centroids.push_back({2.0 * (i % side) + (course % 2 == 0 ? 1.0 : 2.0), course + 0.5});
    }
    centroids.push_back({0.0, 0.0});
    for (Index course = 0; course < side; ++course)
        lay_course(course, side);
}

/// A course stands on the one below, half a brick to the right or to the left of it; between its bricks is half of the stress that the foot has.
void BareWall::lay_course(Index course, Index side)
{
    const double above = 0.25 * mass * gravity * (side - course), beside = 0.125 * mass * gravity * side;  // of a point [N]
    for (Index k = 0; k < side; ++k)
    {
        const Index brick = course * side + k;
        const auto below = [&](Index other)
        { return course == 0 || other < 0 || other >= side ? fixed() : brick - k - side + other; };
        const Index left = course % 2 == 0 ? k - 1 : k;
        add(brick, k == 0 ? fixed() : brick - 1, {-1.0, -1.0}, {-0.5, 0.5}, {1.0, 0.0}, beside);
        add(brick, below(left), {-1.0, 0.0}, {-0.5, -0.5}, {0.0, 1.0}, above);
        add(brick, below(left + 1), {0.0, 1.0}, {-0.5, -0.5}, {0.0, 1.0}, above);
        if (k == side - 1)
            add(brick, fixed(), {1.0, 1.0}, {0.5, -0.5}, {-1.0, 0.0}, beside);
    }
    if (course + 1 < side)  // the half brick of the next course, at its left or right end
    {
        const Index brick = course % 2 == 0 ? course * side : course * side + side - 1;
        const double from = course % 2 == 0 ? 0.0 : 1.0;
        add(brick, fixed(), {from, from - 1.0}, {0.5, 0.5}, {0.0, -1.0}, above - 0.25 * mass * gravity);
    }
}

/// @param x, y   of the points, from the centroid of `a` [m]
/// @param force  normal force of each in the beginning [N]
void BareWall::add(Index a, Index b, const std::array<double, 2>& x, const std::array<double, 2>& y,
                   const std::array<double, 2>& normal, double force)
{
    const std::array<double, 2> along{centroids[a][0] - centroids[b][0] + x[0], centroids[a][1] - centroids[b][1] + y[0]};
    const double offset = along[0] * normal[0] + along[1] * normal[1] + force / normal_stiffness;
    contacts.push_back({a, b, x, y, normal, along, offset});
}
}  // namespace hdem::perf
