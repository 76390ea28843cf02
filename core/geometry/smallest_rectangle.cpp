#include "core/geometry/smallest_rectangle.h"

#include <boost/geometry/algorithms/convex_hull.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <limits>

namespace hdem
{
namespace
{
namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;

/// Area of the smallest rectangle around the hull that has one side along `along`.
double rectangle_area(const std::vector<Vec2>& hull, const Vec2& along)
{
    const Vec2 across(-along.y(), along.x());
    Vec2 low(std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
    Vec2 high = -low;
    for (const Vec2& p : hull)
    {
        const Vec2 at(p.dot(along), p.dot(across));
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    return (high - low).prod();
}
}  // namespace

void SmallestRectangle::add(const std::vector<Vec2>& points)
{
    points_.insert(points_.end(), points.begin(), points.end());
    if (points_.size() > 2 * hull_size_ + 4096)
        keep_hull();
}

void SmallestRectangle::keep_hull()
{
    bg::model::multi_point<Point> cloud;
    for (const Vec2& p : points_)
        cloud.emplace_back(p.x(), p.y());
    bg::model::ring<Point, false, false> hull;
    bg::convex_hull(cloud, hull);
    points_.clear();
    for (const Point& p : hull)
        points_.emplace_back(p.x(), p.y());
    hull_size_ = points_.size();
}

double SmallestRectangle::area()
{
    if (points_.empty())
        return 0.0;
    keep_hull();
    double smallest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const Vec2 edge = points_[i + 1 == points_.size() ? 0 : i + 1] - points_[i];
        if (edge.squaredNorm() > 0.0)
            smallest = std::min(smallest, rectangle_area(points_, edge.normalized()));
    }
    return smallest == std::numeric_limits<double>::max() ? 0.0 : smallest;
}
}  // namespace hdem
