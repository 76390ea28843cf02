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
CutPolygon with_edges(Polygon ring)
{
    const std::size_t n = ring.size();
    return {std::move(ring), std::vector<EdgeTag>(n)};
}

std::vector<CutPolygon> pieces_around(const Polygon& outside, const std::vector<Polygon>& holes)
{
    std::vector<CutPolygon> clockwise;
    for (Polygon hole : holes)
    {
        make_anticlockwise(hole);
        std::ranges::reverse(hole);
        clockwise.push_back(with_edges(std::move(hole)));
    }
    const std::optional<CutPolygon> whole = join_holes(with_edges(outside), std::move(clockwise));
    return whole ? convex_parts(*whole) : std::vector<CutPolygon>();
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

std::vector<Polygon> pieces_of_cell(const Polygon& outside, const std::vector<Polygon>& holes)
{
    double area = std::abs(signed_area(outside));
    for (const Polygon& hole : holes)
        area -= std::abs(signed_area(hole));
    std::vector<CutPolygon> found = pieces_around(outside, holes);
    std::vector<Polygon> pieces;
    if (do_fill(found, area))
        for (CutPolygon& piece : found)
            pieces.push_back(std::move(piece.vertices));
    return pieces;
}
}  // namespace hdem
