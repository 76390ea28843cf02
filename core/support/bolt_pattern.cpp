#include "core/support/bolt_pattern.h"

#include "core/geometry/polygon.h"
#include "core/geometry/unit_direction.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// A straight piece of the outline, all within the arc or all without.
struct Piece
{
    Vec2 from, to;
    bool counts = true;
    [[nodiscard]] double length() const { return (to - from).norm(); }
};

bool is_within(const Vec2& arc, const Vec2& seen)
{
    double angle = std::atan2(seen.y(), seen.x()) * 180.0 / std::numbers::pi;
    while (angle < arc.x())
        angle += 360.0;
    while (angle >= arc.x() + 360.0)
        angle -= 360.0;
    return angle <= arc.y();
}

std::vector<Piece> pieces_of(const Polygon& outline, const std::optional<Vec2>& arc)
{
    Vec2 low = outline.front(), high = outline.front();
    for (const Vec2& p : outline)
    {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const Vec2 middle = 0.5 * (low + high);
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const Vec2 from = outline[i], to = outline[(i + 1) % outline.size()];
        std::vector<double> cuts = {0.0, 1.0};
        for (int end = 0; arc && end < 2; ++end)
        {
            const Vec2 ray = unit_direction((*arc)[end]);
            const double rate = cross(ray, to - from), at = rate != 0.0 ? -cross(ray, from - middle) / rate : -1.0;
            if (at > 0.0 && at < 1.0 && ray.dot(from + at * (to - from) - middle) > 0.0)
                cuts.push_back(at);
        }
        std::ranges::sort(cuts);
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
        {
            Piece piece{from + cuts[k] * (to - from), from + cuts[k + 1] * (to - from)};
            piece.counts = !arc || is_within(*arc, 0.5 * (piece.from + piece.to) - middle);
            if (piece.length() > 0.0)
                pieces.push_back(piece);
        }
    }
    // A stretch within the arc must not begin in its middle.
    const auto gap = std::ranges::find(pieces, false, &Piece::counts);
    std::rotate(pieces.begin(), gap == pieces.end() ? pieces.begin() : gap, pieces.end());
    return pieces;
}

void add_stretch(const Polygon& stretch, const BoltDef& pattern, std::vector<BoltLine>& lines)
{
    double length = 0.0;
    for (std::size_t i = 1; i < stretch.size(); ++i)
        length += (stretch[i] - stretch[i - 1]).norm();
    const double number = std::max(1.0, std::ceil(length / pattern.along - 1e-9));
    const auto along = [&](std::size_t i) { return Vec2((stretch[i] - stretch[i - 1]).normalized()); };
    double passed = 0.0, next = 0.5 * length / number;
    for (std::size_t i = 1; i < stretch.size(); ++i)
    {
        const double piece = (stretch[i] - stretch[i - 1]).norm();
        for (; next < passed + piece; next += length / number)
        {
            // In a corner a bolt halves the angle, on whichever of the two pieces rounding puts it.
            const double slack = 1e-9 * length, way = next - passed;
            Vec2 direction = along(i);
            if (way < slack && i > 1)
                direction = (direction + along(i - 1)).normalized();
            else if (piece - way < slack && i + 1 < stretch.size())
                direction = (direction + along(i + 1)).normalized();
            const Vec2 head = stretch[i - 1] + way * along(i);
            lines.push_back({head, head - pattern.length * turned_left(direction)});
        }
        passed += piece;
    }
}
}  // namespace

std::vector<Polygon> stretches_of(const Polygon& outline, const std::optional<Vec2>& arc)
{
    Polygon anticlockwise = outline;
    double twice_area = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        twice_area += cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
    if (twice_area < 0.0)
        std::ranges::reverse(anticlockwise);
    std::vector<Polygon> stretches;
    bool goes_on = false;
    for (const Piece& piece : pieces_of(anticlockwise, arc))
    {
        if (piece.counts && !goes_on)
            stretches.push_back({piece.from});
        if (piece.counts)
            stretches.back().push_back(piece.to);
        goes_on = piece.counts;
    }
    return stretches;
}

std::vector<BoltLine> bolts_around(const Polygon& outline, const BoltDef& pattern)
{
    std::vector<BoltLine> lines;
    for (const Polygon& stretch : stretches_of(outline, pattern.arc))
        add_stretch(stretch, pattern, lines);
    return lines;
}
}  // namespace hdem
