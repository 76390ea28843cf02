#pragma once
/// Segments of lines that cut the domain, found by place.

#include "core/model/trace_cells.h"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <vector>

namespace hdem
{
class SegmentIndex
{
    using Place = boost::geometry::model::d2::point_xy<double>;
    using Around = boost::geometry::model::box<Place>;
    using Tree = boost::geometry::index::rtree<std::pair<Around, std::size_t>, boost::geometry::index::quadratic<16>>;

    [[nodiscard]] auto begin(const Vec2& p) const { return tree_.qbegin(boost::geometry::index::intersects(Place(p.x(), p.y()))); }

  public:
    /// @param near  what lies nearer to a segment lies on it [m]
    SegmentIndex(const std::vector<TraceSegment>& segments, double near) : segments_(segments), near_(near)
    {
        std::vector<std::pair<Around, std::size_t>> boxes;
        for (std::size_t i = 0; i < segments.size(); ++i)
        {
            const Vec2 low = segments[i].from.cwiseMin(segments[i].to).array() - near;
            const Vec2 high = segments[i].from.cwiseMax(segments[i].to).array() + near;
            boxes.push_back({{{low.x(), low.y()}, {high.x(), high.y()}}, i});
        }
        tree_ = Tree(boxes);
    }

    /// Source of the first segment that both points lie on; no_index when there is none, or a trace of a file.
    [[nodiscard]] std::int32_t source(const Vec2& a, const Vec2& b) const
    {
        std::size_t best = segments_.size();
        for (auto it = begin(a); it != tree_.qend(); ++it)
            if (it->second < best && std::max(distance(a, segments_[it->second]), distance(b, segments_[it->second])) < near_)
                best = it->second;
        return best < segments_.size() ? segments_[best].source : no_index;
    }

    /// Does the end of a line, which is one of the segments' ends, lie on another segment, but on none of its ends?
    [[nodiscard]] bool ends_on_another(const Vec2& end) const
    {
        int ends_there = 0;
        bool lies_on_one = false;
        for (auto it = begin(end); it != tree_.qend(); ++it)
        {
            const TraceSegment& segment = segments_[it->second];
            const bool ends = segment.from == end || segment.to == end;
            ends_there += ends ? 1 : 0;
            lies_on_one = lies_on_one || (!ends && distance(end, segment) < near_);
        }
        return ends_there == 1 && lies_on_one;
    }

  private:
    static double distance(const Vec2& p, const TraceSegment& segment)
    {
        const Vec2 way = segment.to - segment.from;
        const double along = std::clamp(way.dot(p - segment.from) / way.squaredNorm(), 0.0, 1.0);
        return (p - segment.from - along * way).norm();
    }

    const std::vector<TraceSegment>& segments_;
    double near_;
    Tree tree_;
};
}  // namespace hdem
