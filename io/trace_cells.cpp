#include "core/geometry/polygon.h"
#include "core/rock/fault_lines.h"
#include "core/rock/line_stretches.h"
#include "core/rock/weld.h"
#include "io/cell_pieces.h"
#include "io/geos.h"
#include "io/lines_through_corners.h"
#include "io/segment_index.h"
#include "io/traces.h"

#include <algorithm>
#include <iterator>

namespace hdem
{
namespace
{
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

/// Cells in the domain. One with holes comes in convex pieces (cell_pieces.h). Where there are none, what is in the holes, a few blocks inside of one, is dropped.
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
        std::vector<Polygon> pieces = holes.empty() ? std::vector<Polygon>{outside} : pieces_of_cell(outside, holes);
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
