#pragma once
/// Geometries of the library GEOS.

#include "core/check.h"
#include "core/geometry/polygon.h"

#include <fmt/format.h>
#include <geos_c.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hdem
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
}  // namespace hdem
