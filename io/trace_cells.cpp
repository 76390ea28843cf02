#include "core/geometry/polygon.h"
#include "io/traces.h"

#include <fmt/format.h>
#include <geos_c.h>

#include <functional>
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
    [[nodiscard]] Geometry area(Polygon ring) const
    {
        ring.push_back(ring.front());
        GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context_, static_cast<unsigned>(ring.size()), 2);
        for (unsigned i = 0; i < ring.size(); ++i)
            GEOSCoordSeq_setXY_r(context_, sequence, i, ring[i].x(), ring[i].y());
        return own(GEOSGeom_createPolygon_r(context_, GEOSGeom_createLinearRing_r(context_, sequence), nullptr, 0));
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

/// Lines of a collection that are longer than what lengthening may have left over.
std::int64_t count_longer(const Geos& geos, const GEOSGeometry* lines, double least)
{
    std::int64_t count = 0;
    for (int i = 0; i < GEOSGetNumGeometries_r(geos.get(), lines); ++i)
    {
        double length = 0.0;
        GEOSLength_r(geos.get(), GEOSGetGeometryN_r(geos.get(), lines, i), &length);
        count += length > least ? 1 : 0;
    }
    return count;
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
}  // namespace

TraceCells cut_into_cells(const Polygon& domain, const std::vector<Polygon>& traces, double snap)
{
    const Geos geos;
    TraceCells result;
    std::vector<Polygon> all;
    for (const Polygon& trace : traces)
    {
        all.push_back(snap > 0.0 ? lengthened(trace, snap) : trace);
        for (std::size_t i = 1; i < all.back().size(); ++i)
            result.segments.push_back({all.back()[i - 1], all.back()[i]});
    }
    const auto area = geos.area(domain);
    const auto inside = geos.own(
        GEOSIntersection_r(geos.get(), geos.own(GEOSUnaryUnion_r(geos.get(), geos.lines(all).get())).get(), area.get()));
    const auto boundary = geos.own(GEOSBoundary_r(geos.get(), area.get()));
    const auto noded = geos.own(GEOSUnion_r(geos.get(), inside.get(), boundary.get()));
    GEOSGeometry* bridges = nullptr;
    GEOSGeometry* ends = nullptr;
    GEOSGeometry* invalid = nullptr;
    const auto cells = geos.own(GEOSPolygonize_full_r(geos.get(), noded.get(), &bridges, &ends, &invalid));
    const auto owned_bridges = geos.own(bridges);
    const auto owned_ends = geos.own(ends);
    const auto owned_invalid = geos.own(invalid);
    result.traces = static_cast<std::int64_t>(traces.size());
    result.dead_ends = count_longer(geos, ends, snap * (1.0 + 1e-9)) + count_longer(geos, bridges, 0.0);
    for (int i = 0; i < GEOSGetNumGeometries_r(geos.get(), cells.get()); ++i)
    {
        const GEOSGeometry* cell = GEOSGetGeometryN_r(geos.get(), cells.get(), i);
        const bool has_hole = GEOSGetNumInteriorRings_r(geos.get(), cell) > 0;
        result.cells.push_back(
            rings_of(geos, has_hole ? geos.own(GEOSConstrainedDelaunayTriangulation_r(geos.get(), cell)).get() : cell));
    }
    return result;
}
}  // namespace hdem
