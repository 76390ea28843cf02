#include "core/rock/weld.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
std::vector<Box> widened_boxes(const std::vector<Polygon>& outlines, double by)
{
    std::vector<Box> boxes;
    for (const Polygon& outline : outlines)
    {
        const Box box = bounding_box(outline);
        boxes.push_back({box.low.array() - by, box.high.array() + by});
    }
    return boxes;
}

std::vector<Vec2*> vertices_in(CutMass& mass, const std::vector<Box>& boxes)
{
    std::vector<Vec2*> vertices;
    for (CutBlock& block : mass.blocks)
    {
        for (CutPolygon& part : block.parts)
        {
            for (Vec2& p : part.vertices)
            {
                if (std::any_of(boxes.begin(), boxes.end(), [&p](const Box& box) { return box.meets({p, p}); }))
                {
                    vertices.push_back(&p);
                }
            }
        }
    }
    return vertices;
}

void drop_repeated_vertices(CutPolygon& part)
{
    for (std::size_t i = part.vertices.size(); i-- > 0 && part.vertices.size() > 3;)
    {
        if (part.vertices[i] == part.vertices[next(i, part.vertices.size())])
        {
            part.vertices.erase(part.vertices.begin() + static_cast<std::ptrdiff_t>(i));
            part.edges.erase(part.edges.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

bool is_straight(const CutPolygon& part, std::size_t i, double tolerance)
{
    const std::size_t n = part.vertices.size();
    const std::size_t before = previous(i, n);
    if (part.edges[i].source != part.edges[before].source || (part.edges[i].source < 0 && part.edges[i].source != edge_outline))
        return false;
    const Vec2& from = part.vertices[before];
    const Vec2 way = part.vertices[next(i, n)] - from;
    return std::abs(cross(way, part.vertices[i] - from)) < tolerance * way.norm();
}
}  // namespace

void drop_straight_vertices(std::vector<CutPolygon>& parts, double tolerance)
{
    for (CutPolygon& part : parts)
        for (std::size_t i = part.vertices.size(); i-- > 0 && part.vertices.size() > 3;)
            if (is_straight(part, i, tolerance))
            {
                part.vertices.erase(part.vertices.begin() + static_cast<std::ptrdiff_t>(i));
                part.edges.erase(part.edges.begin() + static_cast<std::ptrdiff_t>(i));
            }
}

bool weld_points(std::vector<Vec2*> points, double tolerance)
{
    std::sort(points.begin(), points.end(),
              [](const Vec2* a, const Vec2* b) { return a->x() != b->x() ? a->x() < b->x() : a->y() < b->y(); });
    bool moved = false;
    std::vector<bool> done(points.size(), false);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (done[i])
            continue;
        const Vec2 at = *points[i];
        for (std::size_t j = i + 1; j < points.size() && points[j]->x() - at.x() < tolerance; ++j)
            if (!done[j] && std::abs(points[j]->y() - at.y()) < tolerance)
            {
                moved = moved || *points[j] != at;
                *points[j] = at;
                done[j] = true;
            }
    }
    return moved;
}

void weld_vertices(CutMass& mass, const std::vector<Polygon>& outlines)
{
    if (weld_points(vertices_in(mass, widened_boxes(outlines, mass.tolerance)), mass.tolerance))
        for (CutBlock& block : mass.blocks)
            std::for_each(block.parts.begin(), block.parts.end(), drop_repeated_vertices);
}
}  // namespace hdem
