#include "core/geometry/polygon.h"
#include "core/rock/fault_lines.h"
#include "core/rock/line_stretches.h"
#include "io/traces.h"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <fmt/format.h>
#include <geos_c.h>

#include <algorithm>
#include <functional>
#include <memory>

namespace hdem
{
namespace
{
namespace bg = boost::geometry;

/// The geometry library, with its last message.
class Geos
{
  public:
    Geos() : context_(GEOS_init_r()) { GEOSContext_setErrorMessageHandler_r(context_, remember, this); }
    ~Geos() { GEOS_finish_r(context_); }
    Geos(const Geos&) = delete;
    Geos& operator=(const Geos&) = delete;

    using Geometry = std::unique_ptr<GEOSGeometry, std::function<void(GEOSGeometry*)>>;

    /// Owns it; throws when the library had none to give.
    Geometry own(GEOSGeometry* geometry) const
    {
        if (geometry == nullptr)
            throw InputError(
                std::vector<Problem>{{Problem::Severity::error, "domain.traces_file",
                                      fmt::format("[domain]: traces_file (cannot be cut: {}). Simplify the traces.", message_)}});
        return {geometry, [context = context_](GEOSGeometry* g) { GEOSGeom_destroy_r(context, g); }};
    }
    [[nodiscard]] GEOSContextHandle_t get() const { return context_; }

    [[nodiscard]] Geometry line(const Polygon& points) const
    {
        GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context_, static_cast<unsigned>(points.size()), 2);
        for (unsigned i = 0; i < points.size(); ++i)
            GEOSCoordSeq_setXY_r(context_, sequence, i, points[i].x(), points[i].y());
        return own(GEOSGeom_createLineString_r(context_, sequence));
    }
    [[nodiscard]] Geometry lines(const std::vector<Polygon>& all) const
    {
        std::vector<GEOSGeometry*> parts;
        for (const Polygon& points : all)
            parts.push_back(line(points).release());
        return own(GEOSGeom_createCollection_r(context_, GEOS_MULTILINESTRING, parts.data(), static_cast<unsigned>(parts.size())));
    }
    /// Its points without the last, which is the first.
    [[nodiscard]] Polygon ring(const GEOSGeometry* closed) const
    {
        const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_, closed);
        unsigned size = 0;
        GEOSCoordSeq_getSize_r(context_, sequence, &size);
        Polygon points(size > 0 ? size - 1 : 0);
        for (unsigned i = 0; i < points.size(); ++i)
            GEOSCoordSeq_getXY_r(context_, sequence, i, &points[i].x(), &points[i].y());
        return points;
    }

    /// A point inside an area, or on a line.
    [[nodiscard]] Vec2 point_on(const GEOSGeometry* geometry) const
    {
        const Geometry point = own(GEOSPointOnSurface_r(context_, geometry));
        Vec2 place;
        GEOSGeomGetX_r(context_, point.get(), &place.x());
        GEOSGeomGetY_r(context_, point.get(), &place.y());
        return place;
    }

  private:
    static void remember(const char* message, void* self) { static_cast<Geos*>(self)->message_ = message; }

    GEOSContextHandle_t context_;
    std::string message_ = "no reason given";
};

Polygon lengthened(Polygon trace, double by)
{
    const Vec2 first = trace.front() - trace[1];
    const Vec2 last = trace.back() - trace[trace.size() - 2];
    trace.front() += by * first / first.norm();
    trace.back() += by * last / last.norm();
    return trace;
}

/// The first two points of a line.
std::pair<Vec2, Vec2> begin_of(const Geos& geos, const GEOSGeometry* line)
{
    std::pair<Vec2, Vec2> begin;
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(geos.get(), line);
    GEOSCoordSeq_getXY_r(geos.get(), sequence, 0, &begin.first.x(), &begin.first.y());
    GEOSCoordSeq_getXY_r(geos.get(), sequence, 1, &begin.second.x(), &begin.second.y());
    return begin;
}

/// Middle of the first straight stretch of a line.
Vec2 middle(const Geos& geos, const GEOSGeometry* line)
{
    const auto [first, second] = begin_of(geos, line);
    return 0.5 * (first + second);
}

/// Segments, found by place.
class SegmentIndex
{
  public:
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
        for (auto it = tree_.qbegin(bg::index::intersects(Place(a.x(), a.y()))); it != tree_.qend(); ++it)
            if (it->second < best && std::max(distance(a, segments_[it->second]), distance(b, segments_[it->second])) < near_)
                best = it->second;
        return best < segments_.size() ? segments_[best].source : no_index;
    }

  private:
    using Place = bg::model::d2::point_xy<double>;
    using Around = bg::model::box<Place>;
    using Tree = bg::index::rtree<std::pair<Around, std::size_t>, bg::index::quadratic<16>>;

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

/// Stretches inside the domain that part nothing and are longer than what lengthening may have left over.
void count_dropped(const Geos& geos, const GEOSGeometry* stretches, const Polygon& domain, double least, TraceCells& result)
{
    const double slack = line_slack(domain);
    const SegmentIndex segments(result.segments, 0.01 * slack);
    for (int i = 0; i < GEOSGetNumGeometries_r(geos.get(), stretches); ++i)
    {
        const GEOSGeometry* stretch = GEOSGetGeometryN_r(geos.get(), stretches, i);
        double length = 0.0;
        GEOSLength_r(geos.get(), stretch, &length);
        const auto [first, second] = begin_of(geos, stretch);
        const std::int32_t source = segments.source(first, second);
        if (length <= (source == no_index ? least : 2.0 * slack) || !contains(domain, middle(geos, stretch)))
            continue;
        ++result.dead_ends;
        if (source == no_index)
            result.trace_dropped += length - least;
        else
            result.dropped[static_cast<std::size_t>(source)] += length - slack;  // of its free end
    }
}

void add_segments(const Polygon& points, std::int32_t source, std::vector<TraceSegment>& segments)
{
    for (std::size_t i = 1; i < points.size(); ++i)
        segments.push_back({points[i - 1], points[i], source});
}

/// Outer rings of a collection's areas, anticlockwise.
std::vector<Polygon> rings_of(const Geos& geos, const GEOSGeometry* areas)
{
    std::vector<Polygon> rings;
    for (int i = 0; i < GEOSGetNumGeometries_r(geos.get(), areas); ++i)
    {
        rings.push_back(geos.ring(GEOSGetExteriorRing_r(geos.get(), GEOSGetGeometryN_r(geos.get(), areas, i))));
        make_anticlockwise(rings.back());
    }
    return rings;
}
/// Half of the length of a ring's edges counts as dropped: each of them has two sides.
void drop_ring(const Polygon& ring, const SegmentIndex& segments, TraceCells& result)
{
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
        const Vec2& a = ring[i];
        const Vec2& b = ring[next(i, ring.size())];
        const std::int32_t source = segments.source(a, b);
        (source == no_index ? result.trace_dropped : result.dropped[static_cast<std::size_t>(source)]) += 0.5 * (b - a).norm();
    }
}

/// Cells in the domain. One with holes comes in triangles. The library cannot always find them: then what is in the holes, a few blocks
/// inside of one, is dropped.
void add_cells(const Geos& geos, const GEOSGeometry* cells, const Polygon& domain, TraceCells& result)
{
    std::vector<Vec2> places;
    std::vector<Polygon> filled;
    for (int i = 0; i < GEOSGetNumGeometries_r(geos.get(), cells); ++i)
    {
        const GEOSGeometry* cell = GEOSGetGeometryN_r(geos.get(), cells, i);
        const Vec2 place = geos.point_on(cell);
        if (!contains(domain, place))
            continue;
        places.push_back(place);
        const int holes = GEOSGetNumInteriorRings_r(geos.get(), cell);
        GEOSGeometry* triangles = holes > 0 ? GEOSConstrainedDelaunayTriangulation_r(geos.get(), cell) : nullptr;
        result.cells.push_back(rings_of(geos, triangles != nullptr ? geos.own(triangles).get() : cell));
        for (int h = 0; h < holes && triangles == nullptr; ++h)
            filled.push_back(geos.ring(GEOSGetInteriorRingN_r(geos.get(), cell, h)));
    }
    if (filled.empty())
        return;
    const SegmentIndex segments(result.segments, 0.01 * line_slack(domain));
    for (const Polygon& ring : filled)
        drop_ring(ring, segments, result);
    std::vector<std::vector<Polygon>> kept;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (std::ranges::none_of(filled, [&](const Polygon& ring) { return contains(ring, places[i]); }))
            kept.push_back(std::move(result.cells[i]));
        else
            for (const Polygon& piece : result.cells[i])
                drop_ring(piece, segments, result);
    result.cells = std::move(kept);
}
}  // namespace

TraceCells cut_into_cells(const Polygon& domain, const std::vector<Polygon>& traces, double snap,
                          const std::vector<SourceLine>& lines)
{
    const Geos geos;
    TraceCells result;
    std::vector<Polygon> all;
    for (const SourceLine& line : lines)
    {
        all.push_back(line.points);
        add_segments(line.points, line.source, result.segments);
        result.dropped.resize(std::max(result.dropped.size(), static_cast<std::size_t>(line.source) + 1), 0.0);
    }
    for (const Polygon& trace : traces)
    {
        all.push_back(snap > 0.0 ? lengthened(trace, snap) : trace);
        add_segments(all.back(), no_index, result.segments);
        for (std::size_t i = 1; i < trace.size(); ++i)
            result.trace_length += length_inside(domain, trace[i - 1], trace[i]);
    }
    // All at once, and what lies outside the domain left out later: lines cut off at the boundary before may end a rounding short of it.
    all.push_back(domain);
    all.back().push_back(domain.front());
    const auto noded = geos.own(GEOSUnaryUnion_r(geos.get(), geos.lines(all).get()));
    GEOSGeometry* bridges = nullptr;
    GEOSGeometry* ends = nullptr;
    GEOSGeometry* invalid = nullptr;
    const auto cells = geos.own(GEOSPolygonize_full_r(geos.get(), noded.get(), &bridges, &ends, &invalid));
    const auto owned_bridges = geos.own(bridges);
    const auto owned_ends = geos.own(ends);
    const auto owned_invalid = geos.own(invalid);
    result.traces = static_cast<std::int64_t>(traces.size());
    count_dropped(geos, ends, domain, snap * (1.0 + 1e-9), result);
    count_dropped(geos, bridges, domain, 0.0, result);
    add_cells(geos, cells.get(), domain, result);
    return result;
}
}  // namespace hdem
