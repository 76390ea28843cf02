#include "core/support/bolt_path.h"

#include <algorithm>
#include <tuple>

namespace hdem
{
namespace
{
/// Does the line miss the circle?
bool misses(const Vec2& from, const Vec2& direction, double length, const Vec2& centre, double radius)
{
    const double at = std::clamp(direction.dot(centre - from), 0.0, length);
    return (from + at * direction - centre).squaredNorm() > radius * radius;
}

/// The line within a convex part; empty where `from` is not below `to`.
PathPiece clipped(const Vec2& from, const Vec2& direction, double length, Index part, const Shapes& shapes)
{
    PathPiece piece{.block = shapes.part_block[part], .from = 0.0, .to = length};
    for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
    {
        const Vec2& along = shapes.edge_tangent[v];
        const double inside = cross(along, from - shapes.vertex[v]), rate = cross(along, direction);
        if (std::abs(rate) < 1e-12)
            piece.to = inside < -1e-12 * length ? -1.0 : piece.to;
        else if (rate > 0.0)
            piece.from = std::max(piece.from, -inside / rate);
        else
            piece.to = std::min(piece.to, -inside / rate);
    }
    return piece;
}
}  // namespace

std::vector<PathPiece> pieces_along(const Vec2& from, const Vec2& to, const Model& model, const Blocks& blocks,
                                    const std::vector<std::uint8_t>& skipped)
{
    const double length = (to - from).norm(), least = 1e-9 * length, seam = 1e-6 * length;
    const Vec2 direction = (to - from) / length;
    std::vector<PathPiece> found;
    for (Index part = 0; part < model.shapes.parts(); ++part)
    {
        const Index block = model.shapes.part_block[part];
        const Vec2 start = from - Vec2(blocks.motion[block].x, blocks.motion[block].y);
        if (skipped[block] != 0 ||
            misses(start, direction, length, model.shapes.part_centre[part], 1.001 * model.shapes.part_radius[part]))
            continue;
        const PathPiece piece = clipped(start, direction, length, part, model.shapes);
        if (piece.to - piece.from > least)
            found.push_back(piece);
    }
    std::ranges::sort(found, {}, [&](const PathPiece& p) { return std::tuple(p.from, model.user_number[p.block]); });
    std::vector<PathPiece> pieces;
    for (PathPiece piece : found)
    {
        piece.from = pieces.empty() ? piece.from : std::max(piece.from, pieces.back().to);
        if (piece.to - piece.from <= least)
            continue;
        // Convex parts of a block follow each other; beyond a notch it begins anew.
        if (!pieces.empty() && pieces.back().block == piece.block && piece.from - pieces.back().to <= seam)
            pieces.back().to = piece.to;
        else
            pieces.push_back(piece);
    }
    return pieces;
}
}  // namespace hdem
