#include "core/water/pore_pressure.h"

#include <boost/polygon/voronoi.hpp>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double grid = 1 << 30;  ///< Boost.Polygon takes 32-bit integers

struct GridPoint
{
    int x, y;
};
}  // namespace
}  // namespace hdem

template <>
struct boost::polygon::geometry_concept<hdem::GridPoint>
{
    using type = point_concept;
};
template <>
struct boost::polygon::point_traits<hdem::GridPoint>
{
    using coordinate_type = int;
    static coordinate_type get(const hdem::GridPoint& p, orientation_2d axis) { return axis == HORIZONTAL ? p.x : p.y; }
};

namespace hdem
{
bool make_triangles(PressureField& field)
{
    Vec2 low = field.points.front(), high = low;
    for (const Vec2& p : field.points)
    {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double scale = grid / std::max((high - low).maxCoeff(), 1e-300);
    std::vector<GridPoint> points;
    for (const Vec2& p : field.points)
    {
        const Vec2 at = scale * (p - low);
        points.push_back({static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))});
    }
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
    field.triangle.clear();
    for (const auto& corner : diagram.vertices())  // of the cells; the points around it are a triangle, or more on one circle
    {
        std::vector<Index> around;
        const auto* edge = corner.incident_edge();
        do
        {
            around.push_back(static_cast<Index>(edge->cell()->source_index()));
            edge = edge->rot_next();
        } while (edge != corner.incident_edge());
        for (std::size_t i = 1; i + 1 < around.size(); ++i)
        {
            std::array<Index, 3> t{around[0], around[i], around[i + 1]};
            const double area = cross(field.points[t[1]] - field.points[t[0]], field.points[t[2]] - field.points[t[0]]);
            if (area < 0.0)
                std::swap(t[1], t[2]);
            if (area != 0.0)
                field.triangle.push_back(t);
        }
    }
    return !field.triangle.empty();
}
}  // namespace hdem
