#include "core/geometry/reflex_vertices.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace hdem
{
std::vector<std::uint8_t> reflex_vertices(const std::vector<ConvexPart>& parts)
{
    struct Corner
    {
        double x, y, angle;
        std::size_t vertex;
    };
    std::vector<Corner> corners;
    for (const ConvexPart& part : parts)
        for (std::size_t i = 0, n = part.vertices.size(); i < n; ++i)
        {
            const Vec2& at = part.vertices[i];
            const Vec2 to = part.vertices[next(i, n)] - at, from = part.vertices[(i + n - 1) % n] - at;
            const double angle = std::atan2(cross(to, from), to.dot(from));  // of a straight side, rounding may make it -pi
            corners.push_back({at.x(), at.y(), angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle, corners.size()});
        }
    std::vector<std::uint8_t> reflex(corners.size(), 0);
    if (parts.size() == 1)
        return reflex;
    std::ranges::sort(corners, {}, [](const Corner& c) { return std::tuple(c.x, c.y, c.vertex); });
    constexpr double straight = std::numbers::pi + 1e-6;
    for (auto first = corners.begin(); first != corners.end();)
    {
        double sum = 0.0;
        auto last = first;
        for (; last != corners.end() && last->x == first->x && last->y == first->y; ++last)
            sum += last->angle;
        for (; first != last; ++first)
            reflex[first->vertex] = sum > straight ? 1 : 0;
    }
    return reflex;
}
}  // namespace hdem
