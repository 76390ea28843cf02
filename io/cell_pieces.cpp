#include "io/cell_pieces.h"

#include "core/geometry/convex_decomposition.h"
#include "core/geometry/hole_joining.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hdem
{
namespace
{
CutPolygon with_edges(Polygon ring, const EdgeTag& edge)
{
    const std::size_t n = ring.size();
    return {std::move(ring), std::vector<EdgeTag>(n, edge)};
}

std::vector<CutPolygon> own_pieces(const Polygon& outside, const std::vector<Polygon>& holes)
{
    std::vector<CutPolygon> clockwise;
    for (Polygon hole : holes)
    {
        make_anticlockwise(hole);
        std::ranges::reverse(hole);
        clockwise.push_back(with_edges(std::move(hole), {}));
    }
    const std::optional<CutPolygon> whole = join_holes(with_edges(outside, {}), std::move(clockwise));
    return whole ? convex_parts(*whole) : std::vector<CutPolygon>();
}

std::vector<CutPolygon> delaunay_pieces(const Geos& geos, const GEOSGeometry* cell)
{
    std::vector<CutPolygon> pieces;
    GEOSGeometry* const triangles = GEOSConstrainedDelaunayTriangulation_r(geos.get(), cell);
    if (triangles == nullptr)
        return pieces;
    const Geos::Geometry owned = geos.own(triangles);
    for (int i = 0; i < GEOSGetNumGeometries_r(geos.get(), triangles); ++i)
    {
        Polygon triangle = geos.ring(GEOSGetExteriorRing_r(geos.get(), GEOSGetGeometryN_r(geos.get(), triangles, i)));
        make_anticlockwise(triangle);
        pieces.push_back(with_edges(std::move(triangle), {edge_internal, no_index}));
    }
    merge_convex_parts(pieces);
    return pieces;
}

/// Do they lie beside each other, all in the right sense?
bool do_fill(const std::vector<CutPolygon>& pieces, double area)
{
    double sum = 0.0;
    for (const CutPolygon& piece : pieces)
        sum += std::abs(signed_area(piece.vertices));
    return std::abs(sum - area) <= 1e-9 * area &&
           std::ranges::all_of(pieces, [](const CutPolygon& piece) { return signed_area(piece.vertices) > 0.0; });
}
}  // namespace

std::vector<Polygon> pieces_of_cell(const Geos& geos, const GEOSGeometry* cell, const Polygon& outside,
                                    const std::vector<Polygon>& holes)
{
    double area = std::abs(signed_area(outside));
    for (const Polygon& hole : holes)
        area -= std::abs(signed_area(hole));
    std::vector<CutPolygon> found = own_pieces(outside, holes);
    if (!do_fill(found, area))
        found = delaunay_pieces(geos, cell);
    std::vector<Polygon> pieces;
    if (do_fill(found, area))
        for (CutPolygon& piece : found)
            pieces.push_back(std::move(piece.vertices));
    return pieces;
}
}  // namespace hdem
