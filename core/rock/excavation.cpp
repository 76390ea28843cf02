#include "core/rock/excavation.h"

#include "core/geometry/unit_direction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hdem
{
namespace
{
using Parts = std::vector<CutPolygon>;

/// `segments` edges over an angle of sweep_deg that begins on the right, the last vertex included.
void add_arc(Polygon& polygon, const Vec2& centre, double radius, double sweep_deg, int segments)
{
    for (int i = 0; i <= segments; ++i)
    {
        polygon.push_back(centre + radius * unit_direction(sweep_deg * i / segments));
    }
}

/// An edge of an outline as a line with the length that counts.
struct OutlineEdge
{
    CutLine line;
    Vec2 end;
    double length;
};

std::vector<OutlineEdge> edges_of(const Polygon& outline)
{
    std::vector<OutlineEdge> edges;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const Vec2& end = outline[next(i, outline.size())];
        const double length = (end - outline[i]).norm();
        edges.push_back({{outline[i], (end - outline[i]) / length}, end, length});
    }
    return edges;
}

/// Does the edge itself, not only its line, run through the inside of a convex polygon?
bool runs_through(const OutlineEdge& edge, const Polygon& polygon, double tolerance)
{
    if (side_of(polygon, edge.line, tolerance) != Side::crossed)
    {
        return false;
    }
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    const auto visit = [&](const Vec2& p)
    {
        const double along = edge.line.direction.dot(p - edge.line.point);
        low = std::min(low, along);
        high = std::max(high, along);
    };
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vec2& p = polygon[i];
        const Vec2& q = polygon[next(i, polygon.size())];
        const double side_p = edge.line.side(p);
        const double side_q = edge.line.side(q);
        if (std::abs(side_p) < tolerance)
        {
            visit(p);
        }
        else if (std::abs(side_q) >= tolerance && (side_p > 0.0) != (side_q > 0.0))
        {
            visit(p + (q - p) * (side_p / (side_p - side_q)));
        }
    }
    return std::min(high, edge.length) - std::max(low, 0.0) > tolerance;
}

/// Later cuts that meet the new chord at an end of the outline's edge find the outline's own vertex there.
void record_ends(Chords& chords, Index chord, const ConvexCut& cut, const OutlineEdge& edge, double tolerance)
{
    const double length = chords.position(chord, cut.to);
    for (const Vec2& vertex : {edge.line.point, edge.end})
    {
        const double where = chords.position(chord, vertex);
        if (where > tolerance && where < length - tolerance)
        {
            chords.record(chord, vertex);
        }
    }
}

/// Pieces of a part that no edge of the outline runs through.
Parts pieces_along(const CutPolygon& part, const std::vector<OutlineEdge>& edges, Chords& chords, double tolerance)
{
    Parts pieces = {part};
    for (const OutlineEdge& edge : edges)
    {
        const std::size_t before = pieces.size();
        for (std::size_t p = 0; p < before; ++p)
        {
            if (runs_through(edge, pieces[p].vertices, tolerance))
            {
                ConvexCut cut = plan_cut(pieces[p], edge.line, edge_internal, chords, tolerance);
                record_ends(chords, commit(cut, chords), cut, edge, tolerance);
                pieces[p] = std::move(cut.left);
                pieces.push_back(std::move(cut.right));
            }
        }
    }
    return pieces;
}

bool meets(const Parts& parts, const Box& box)
{
    return std::any_of(parts.begin(), parts.end(), [&](const CutPolygon& p) { return bounding_box(p.vertices).meets(box); });
}

/// Connected pieces of one side, each as a block.
void add_blocks(Parts&& side, Index excavation, Index outline, const CutMass& mass, std::vector<CutBlock>& out)
{
    const std::vector<std::size_t> group = connected_groups(side, mass.chords, mass.tolerance);
    const std::size_t before = out.size();
    for (std::size_t p = 0; p < side.size(); ++p)
    {
        if (before + group[p] == out.size())
        {
            out.push_back({{}, excavation, outline});
        }
        out[before + group[p]].parts.push_back(std::move(side[p]));
    }
}

/// The area inside outline `number` and the domain, without earlier excavations.
Parts single_block(CutMass& mass, const std::vector<Polygon>& outlines, std::size_t number)
{
    Parts parts = separate(mass.domain, outlines[number], mass.chords, mass.tolerance).inside;
    for (std::size_t earlier = 0; earlier < number; ++earlier)
    {
        parts = separate(std::move(parts), outlines[earlier], mass.chords, mass.tolerance).outside;
    }
    return parts;
}
}  // namespace

Polygon outline_polygon(const ExcavationDef& excavation)
{
    const Vec2& at = excavation.position;
    const double half = 0.5 * excavation.width;
    Polygon polygon;
    switch (excavation.shape)
    {
    case OutlineShape::horseshoe:
        polygon = {at - Vec2(half, 0.0), at + Vec2(half, 0.0)};
        add_arc(polygon, at + Vec2(0.0, excavation.height - half), half, 180.0, excavation.arc_segments);
        break;
    case OutlineShape::circle:
        add_arc(polygon, at, 0.5 * excavation.diameter, 360.0, excavation.arc_segments);
        polygon.pop_back();  // the last vertex is the first
        break;
    case OutlineShape::rectangle:
        polygon = {at - Vec2(half, 0.0), at + Vec2(half, 0.0), at + Vec2(half, excavation.height),
                   at + Vec2(-half, excavation.height)};
        break;
    case OutlineShape::polygon:
        polygon = excavation.polygon;
        break;
    }
    make_anticlockwise(polygon);
    return polygon;
}

Separated separate(Parts parts, const Polygon& outline, Chords& chords, double tolerance)
{
    const std::vector<OutlineEdge> edges = edges_of(outline);
    const Box box = bounding_box(outline);
    Separated out;
    for (CutPolygon& part : parts)
    {
        if (!bounding_box(part.vertices).meets(box))
        {
            out.outside.push_back(std::move(part));
            continue;
        }
        for (CutPolygon& piece : pieces_along(part, edges, chords, tolerance))
        {
            const bool is_inside = contains(outline, area_moments(piece.vertices).centroid);
            (is_inside ? out.inside : out.outside).push_back(std::move(piece));
        }
    }
    for (CutPolygon& a : out.inside)
    {
        for (CutPolygon& b : out.outside)
        {
            set_shared_source(a, b, edge_outline, chords, tolerance);
        }
    }
    return out;
}

std::size_t cut_outline(CutMass& mass, const std::vector<Polygon>& outlines, std::size_t number, InsideOutline inside)
{
    const Polygon& outline = outlines[number];
    const Box box = bounding_box(outline);
    const Index excavation = static_cast<Index>(number);
    std::vector<CutBlock> out;
    out.reserve(mass.blocks.size());
    std::size_t count = 0;
    for (CutBlock& block : mass.blocks)
    {
        if (block.excavation != no_index || !meets(block.parts, box))
        {
            out.push_back(std::move(block));
            continue;
        }
        Separated sides = separate(block.parts, outline, mass.chords, mass.tolerance);
        if (sides.inside.empty())
        {
            out.push_back(std::move(block));
            continue;
        }
        const Index cut_by = sides.outside.empty() ? block.outline : excavation;
        if (inside == InsideOutline::jointed)
        {
            const std::size_t before = out.size();
            add_blocks(std::move(sides.inside), excavation, cut_by, mass, out);
            count += out.size() - before;
        }
        add_blocks(std::move(sides.outside), no_index, cut_by, mass, out);
    }
    mass.blocks = std::move(out);
    if (inside == InsideOutline::one_block)
    {
        const std::size_t before = mass.blocks.size();
        add_blocks(single_block(mass, outlines, number), excavation, no_index, mass, mass.blocks);
        count = mass.blocks.size() - before;
    }
    return count;
}
}  // namespace hdem
