#include "core/geometry/convex_decomposition.h"
#include "core/geometry/hole_joining.h"
#include "core/geometry/polygon.h"
#include "core/rock/fault_lines.h"
#include "core/rock/line_stretches.h"
#include "core/rock/weld.h"
#include "io/lines_through_corners.h"
#include "io/segment_index.h"
#include "io/traces.h"

#include <fmt/format.h>
#include <geos_c.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>

namespace hdem
{
namespace
{
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
    [[nodiscard]] Polygon points(const GEOSGeometry* line) const
    {
        const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_, line);
        unsigned size = 0;
        GEOSCoordSeq_getSize_r(context_, sequence, &size);
        Polygon points(size);
        for (unsigned i = 0; i < size; ++i)
            GEOSCoordSeq_getXY_r(context_, sequence, i, &points[i].x(), &points[i].y());
        return points;
    }
    /// Its points without the last, which is the first.
    [[nodiscard]] Polygon ring(const GEOSGeometry* closed) const
    {
        Polygon ring = points(closed);
        if (!ring.empty())
            ring.pop_back();
        return ring;
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

void lengthen(Vec2& end, const Vec2& before, double by)
{
    const Vec2 way = end - before;
    end += by * way / way.norm();
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

/// Stretches inside the domain that part nothing and are longer than what lengthening may have left over.
/// @param snap  by which the user lengthens traces [m]
void count_dropped(const Geos& geos, const GEOSGeometry* stretches, const Polygon& domain, double least, double snap,
                   TraceCells& result)
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
            result.trace_dropped += length - snap;
        else
            result.dropped[static_cast<std::size_t>(source)] += length - slack;  // of its free end
    }
}

void add_segments(const Polygon& points, std::int32_t source, std::vector<TraceSegment>& segments)
{
    for (std::size_t i = 1; i < points.size(); ++i)
        segments.push_back({points[i - 1], points[i], source});
}

/// Convex pieces of a cell with holes. Nothing where round-off leaves no way to a hole.
std::vector<Polygon> pieces_around_holes(Polygon outside, const std::vector<Polygon>& holes)
{
    const auto polygon_of = [](Polygon ring)
    {
        const std::size_t n = ring.size();
        return CutPolygon{std::move(ring), std::vector<EdgeTag>(n)};
    };
    std::vector<CutPolygon> clockwise;
    for (Polygon hole : holes)
    {
        make_anticlockwise(hole);
        std::ranges::reverse(hole);
        clockwise.push_back(polygon_of(std::move(hole)));
    }
    std::vector<Polygon> pieces;
    if (const std::optional<CutPolygon> whole = join_holes(polygon_of(std::move(outside)), std::move(clockwise)))
        for (CutPolygon& part : convex_parts(*whole))
            pieces.push_back(std::move(part.vertices));
    return pieces;
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

/// Cells in the domain. One with holes comes in convex pieces. Where there are none, what is in the holes, a few blocks inside of one, is dropped.
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
        Polygon outside = geos.ring(GEOSGetExteriorRing_r(geos.get(), cell));
        make_anticlockwise(outside);
        std::vector<Polygon> holes;
        for (int h = 0; h < GEOSGetNumInteriorRings_r(geos.get(), cell); ++h)
            holes.push_back(geos.ring(GEOSGetInteriorRingN_r(geos.get(), cell, h)));
        std::vector<Polygon> pieces = holes.empty() ? std::vector<Polygon>{outside} : pieces_around_holes(outside, holes);
        if (pieces.empty())
        {
            pieces = {std::move(outside)};
            std::ranges::move(holes, std::back_inserter(filled));
        }
        result.cells.push_back(std::move(pieces));
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

/// Distance by which round-off may part what meets [m].
double round_off(const Polygon& domain)
{
    const Box box = bounding_box(domain);
    const double largest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    return std::max(1e-9 * (box.high - box.low).norm(), 64.0 * std::numeric_limits<double>::epsilon() * largest);
}

/// Lines that meet almost in one point leave stretches as short as a rounding between them. What is cut further would lose its corners there.
Geos::Geometry welded(const Geos& geos, Geos::Geometry noded, double by)
{
    std::vector<Polygon> stretches;
    for (int i = 0; i < GEOSGetNumGeometries_r(geos.get(), noded.get()); ++i)
        stretches.push_back(geos.points(GEOSGetGeometryN_r(geos.get(), noded.get(), i)));
    std::vector<Vec2*> points;
    for (Polygon& stretch : stretches)
        for (Vec2& point : stretch)
            points.push_back(&point);
    if (!weld_points(std::move(points), by))
        return noded;
    for (Polygon& stretch : stretches)
        stretch.erase(std::unique(stretch.begin(), stretch.end()), stretch.end());
    std::erase_if(stretches, [](const Polygon& stretch) { return stretch.size() < 2; });
    return geos.own(GEOSUnaryUnion_r(geos.get(), geos.lines(stretches).get()));  // two may have become one
}

/// Ends of traces that lie on another trace or on a side, as far as numbers can tell, cross it; they may end a rounding short of it.
void let_meet(const Polygon& domain, const std::vector<SourceLine>& lines, std::vector<Polygon>& traces, double by)
{
    std::vector<TraceSegment> segments;
    for (const SourceLine& line : lines)
        add_segments(line.points, line.source, segments);
    for (const Polygon& trace : traces)
        add_segments(trace, no_index, segments);
    for (std::size_t i = 0; i < domain.size(); ++i)
        segments.push_back({domain[i], domain[next(i, domain.size())], no_index});
    const SegmentIndex index(segments, 0.1 * by);
    for (Polygon& trace : traces)
    {
        const bool begins = index.ends_on_another(trace.front()), ends = index.ends_on_another(trace.back());
        if (begins)
            lengthen(trace.front(), trace[1], by);
        if (ends)
            lengthen(trace.back(), trace[trace.size() - 2], by);
    }
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
        result.dropped.resize(std::max(result.dropped.size(), static_cast<std::size_t>(line.source) + 1), 0.0);
    }
    const double by = std::max(snap, 10.0 * round_off(domain));
    std::vector<Polygon> cutting = traces;
    if (snap <= 0.0)
        let_meet(domain, lines, cutting, by);
    for (std::size_t t = 0; t < traces.size(); ++t)
    {
        const Polygon& trace = traces[t];
        if (snap > 0.0)
        {
            lengthen(cutting[t].front(), trace[1], snap);
            lengthen(cutting[t].back(), trace[trace.size() - 2], snap);
        }
        all.push_back(cutting[t]);
        for (std::size_t i = 1; i < trace.size(); ++i)
            result.trace_length += length_inside(domain, trace[i - 1], trace[i]);
    }
    lead_through_corners(domain, 0.1 * line_slack(domain), all);
    for (std::size_t i = 0; i < all.size(); ++i)
        add_segments(all[i], i < lines.size() ? lines[i].source : no_index, result.segments);
    // All at once, and what lies outside the domain left out later: lines cut off at the boundary before may end a rounding short of it.
    all.push_back(domain);
    all.back().push_back(domain.front());
    const auto noded = welded(geos, geos.own(GEOSUnaryUnion_r(geos.get(), geos.lines(all).get())), round_off(domain));
    GEOSGeometry* bridges = nullptr;
    GEOSGeometry* ends = nullptr;
    GEOSGeometry* invalid = nullptr;
    const auto cells = geos.own(GEOSPolygonize_full_r(geos.get(), noded.get(), &bridges, &ends, &invalid));
    const auto owned_bridges = geos.own(bridges);
    const auto owned_ends = geos.own(ends);
    const auto owned_invalid = geos.own(invalid);
    result.traces = static_cast<std::int64_t>(traces.size());
    count_dropped(geos, ends, domain, snap > 0.0 ? by * (1.0 + 1e-9) : 2.0 * by, snap, result);
    count_dropped(geos, bridges, domain, 0.0, 0.0, result);
    add_cells(geos, cells.get(), domain, result);
    return result;
}
}  // namespace hdem
