#include "io/lines_through_corners.h"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace hdem
{
namespace
{
namespace geometry = boost::geometry;

class Corners
{
    using Place = geometry::model::d2::point_xy<double>;
    using Around = geometry::model::box<Place>;

  public:
    /// @param piece  long lines are looked at in pieces of this length: the box around a whole one would have most of the domain in it [m]
    Corners(double near, double piece) : near_(near), piece_(piece) {}

    /// The corner at a place; the place itself becomes one where there is none.
    Vec2 at(const Vec2& place)
    {
        Vec2 nearest = place;
        double least = near_;
        for_each_within(place, place,
                        [&](const Vec2& corner)
                        {
                            if (const double distance = (corner - place).norm(); distance < least)
                                std::tie(nearest, least) = std::pair(corner, distance);
                        });
        if (least == near_)
            tree_.insert(Place(place.x(), place.y()));
        return nearest;
    }

    /// Those that the straight way between two of them passes, in their order on it.
    [[nodiscard]] Polygon between(const Vec2& from, const Vec2& to) const
    {
        const Vec2 way = to - from;
        std::vector<std::pair<double, Vec2>> passed;
        const auto look = [&](const Vec2& corner)
        {
            const double along = way.dot(corner - from) / way.squaredNorm();
            const bool is_inside = corner != from && corner != to && along > 0.0 && along < 1.0;
            if (is_inside && (corner - from - along * way).norm() < near_)
                passed.emplace_back(along, corner);
        };
        const int pieces = 1 + static_cast<int>(std::min(way.norm() / piece_, 1000.0));
        for (int i = 0; i < pieces; ++i)
            for_each_within(from + i * way / pieces, from + (i + 1) * way / pieces, look);
        std::ranges::sort(passed, {}, &std::pair<double, Vec2>::first);
        Polygon points;
        for (const auto& [along, corner] : passed)
            if (points.empty() || points.back() != corner)
                points.push_back(corner);
        return points;
    }

  private:
    template <typename Visit>
    void for_each_within(const Vec2& a, const Vec2& b, const Visit& visit) const
    {
        const Vec2 low = a.cwiseMin(b).array() - near_, high = a.cwiseMax(b).array() + near_;
        const Around around({low.x(), low.y()}, {high.x(), high.y()});
        for (auto it = tree_.qbegin(geometry::index::intersects(around)); it != tree_.qend(); ++it)
            visit(Vec2(it->x(), it->y()));
    }

    double near_, piece_;
    geometry::index::rtree<Place, geometry::index::quadratic<16>> tree_;
};
}  // namespace

void lead_through_corners(const Polygon& domain, double near, std::vector<Polygon>& lines)
{
    const Box box = bounding_box(domain);
    Corners corners(near, (box.high - box.low).norm() / 32.0);
    for (const Vec2& vertex : domain)
        corners.at(vertex);
    for (Polygon& line : lines)
        if (line.front() == line.back())
        {
            for (Vec2& point : line)
                point = corners.at(point);
        }
        else
            for (std::size_t i = 1; i + 1 < line.size(); ++i)
                line[i] = corners.at(line[i]);
    for (Polygon& line : lines)
    {
        Polygon led{line.front()};
        for (std::size_t i = 1; i < line.size(); ++i)
        {
            if (line[i] == line[i - 1])
                continue;
            std::ranges::copy(corners.between(line[i - 1], line[i]), std::back_inserter(led));
            led.push_back(line[i]);
        }
        if (led.size() > 1)
            line = std::move(led);
    }
}
}  // namespace hdem
