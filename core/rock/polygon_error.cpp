#include "core/rock/polygon_error.h"

#include "core/geometry/polygon.h"
#include "core/rock/problem_text.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
bool lie_on_a_line(const Polygon& points)
{
    const auto from_first = [&](const Vec2& p) { return (p - points.front()).squaredNorm(); };
    const Vec2 farthest = *std::max_element(points.begin(), points.end(),
                                            [&](const Vec2& a, const Vec2& b) { return from_first(a) < from_first(b); });
    const Vec2 along = farthest - points.front();
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec2& p) { return std::abs(cross(along, p - points.front())) <= 1e-12 * along.squaredNorm(); });
}
}  // namespace

std::string polygon_error(const Polygon& polygon)
{
    if (polygon.size() < 3)
    {
        return "vertices = " + std::to_string(polygon.size()) + " (at least 3 enclose an area). Add vertices.";
    }
    if (polygon.size() > most_vertices)
    {
        return "vertices = " + std::to_string(polygon.size()) + " (at most " + std::to_string(most_vertices) +
               "). Leave out those that do not change the shape, or cut it into blocks.";
    }
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        if (!polygon[i].allFinite())
        {
            return "vertex " + std::to_string(i) + " = " + text(polygon[i]) + " (must be finite). Correct it.";
        }
    }
    if (lie_on_a_line(polygon))
    {
        return "area = 0 m2 (its vertices lie on a line). Move a vertex.";
    }
    if (const auto crossing = find_self_crossing(polygon))
    {
        return "edges " + std::to_string(crossing->edge_a) + " and " + std::to_string(crossing->edge_b) + " meet at " +
               text(crossing->point) +
               " (edge 0 runs from the first to the second vertex; edges may meet in the vertex between them only). Give the "
               "vertices "
               "in order around the area, each once.";
    }
    return {};
}
}  // namespace hdem
