#include "core/rock/split_sides.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hdem
{
namespace
{
bool parts_a_side(const CutPolygon& part, std::size_t i, double tolerance)
{
    const std::size_t n = part.vertices.size(), before = previous(i, n);
    const std::int32_t first = part.edges[before].source, second = part.edges[i].source;
    if (n < 4 || first == second || first == edge_internal || second == edge_internal)
        return false;
    const Vec2 way = part.vertices[next(i, n)] - part.vertices[before];
    return std::abs(cross(way, part.vertices[i] - part.vertices[before])) <= tolerance * way.norm();
}

/// The vertices from i on to j.
CutPolygon piece(const CutPolygon& part, std::size_t i, std::size_t j)
{
    CutPolygon out;
    for (std::size_t k = i; k != j; k = next(k, part.vertices.size()))
        out.add(part.vertices[k], part.edges[k]);
    out.add(part.vertices[j], {edge_internal, no_index});
    return out;
}

std::optional<std::pair<CutPolygon, CutPolygon>> split(const CutPolygon& part, double tolerance)
{
    const std::size_t n = part.vertices.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        if (!parts_a_side(part, i, tolerance))
            continue;
        std::optional<std::pair<CutPolygon, CutPolygon>> best;
        double least = 0.0;
        for (std::size_t j = 0; j < n; ++j)
        {
            if (j == i || j == next(i, n) || j == previous(i, n))
                continue;
            std::pair<CutPolygon, CutPolygon> pieces{piece(part, i, j), piece(part, j, i)};
            if (const double area = std::min(signed_area(pieces.first.vertices), signed_area(pieces.second.vertices)); area > least)
            {
                least = area;
                best = std::move(pieces);
            }
        }
        if (best)
            return best;
    }
    return std::nullopt;
}
}  // namespace

void split_sides(std::vector<CutPolygon>& parts, double tolerance)
{
    for (std::size_t p = 0; p < parts.size(); ++p)
        while (std::optional<std::pair<CutPolygon, CutPolygon>> pieces = split(parts[p], tolerance))
        {
            parts[p] = std::move(pieces->first);
            parts.push_back(std::move(pieces->second));
        }
}
}  // namespace hdem
