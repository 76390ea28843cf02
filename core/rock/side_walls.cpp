#include "core/rock/side_walls.h"

#include "core/rock/block_overlap.h"
#include "core/rock/problem_text.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace hdem
{
namespace
{
/// Of the smaller one's area: coordinates are typed with a few digits.
constexpr double accepted_overlap = 1e-6;

bool is_on_side(const Vec2& a, const Vec2& b, const Box& box, const std::string& side)
{
    const double slack = 1e-9 * (box.high - box.low).maxCoeff();
    const auto on = [slack](double a_value, double b_value, double limit)
    { return std::abs(a_value - limit) <= slack && std::abs(b_value - limit) <= slack; };
    return (side == "left" && on(a.x(), b.x(), box.low.x())) || (side == "right" && on(a.x(), b.x(), box.high.x())) ||
           (side == "bottom" && on(a.y(), b.y(), box.low.y())) || (side == "top" && on(a.y(), b.y(), box.high.y()));
}

/// How much longer than its edge a wall is at a corner [m]: by its thickness at a convex corner; below 0, up to the bisector, at a concave one.
/// @param before, after  directions of the two edges that meet
double reach(const Vec2& before, const Vec2& after, double thickness)
{
    const double turn = std::atan2(cross(before, after), before.dot(after));  // > 0: convex
    constexpr double straight = 1e-9;
    return turn > straight ? thickness : (turn < -straight ? -thickness * std::tan(-0.5 * turn) : 0.0);
}

bool needs_wall(const BoundaryDef& def)
{
    return def.kind != BoundaryKind::fixed && def.kind != BoundaryKind::stress;
}

RockBlock wall_block(const std::string& name, const std::string& material, Polygon outline)
{
    RockBlock block;
    block.name = name;
    block.material = material;
    block.fix_x = block.fix_y = block.fix_rotation = true;
    const std::size_t edges = outline.size();
    block.parts.push_back({std::move(outline), std::vector<std::int32_t>(edges, edge_wall)});
    return block;
}
}  // namespace

std::set<Index> edges_of(const Polygon& polygon, bool reversed, const std::vector<std::string>& sides,
                         const std::vector<int>& numbers)
{
    std::set<Index> edges;
    const std::size_t n = polygon.size();
    const Box box = bounding_box(polygon);
    for (std::size_t i = 0; i < n; ++i)
    {
        const std::size_t as_given = reversed ? (2 * n - 2 - i) % n : i;
        const auto is_on = [&](const std::string& side) { return is_on_side(polygon[i], polygon[next(i, n)], box, side); };
        if (std::ranges::find(numbers, static_cast<int>(as_given)) != numbers.end() || std::ranges::any_of(sides, is_on))
            edges.insert(static_cast<Index>(i));
    }
    return edges;
}

Polygon wall_behind(const Polygon& polygon, std::size_t edge, double thickness)
{
    const std::size_t n = polygon.size();
    const auto direction = [&](std::size_t i) -> Vec2 { return (polygon[next(i, n)] - polygon[i]).normalized(); };
    const Vec2 start = polygon[edge], end = polygon[next(edge, n)], along = direction(edge), out = -turned_left(along);
    const double length = (end - start).norm();
    const Vec2 before = direction(previous(edge, n)), after = direction(next(edge, n));
    double depth = thickness;
    const auto at_start = [&] { return reach(before, along, depth); };
    const auto at_end = [&] { return reach(along, after, depth); };
    while (std::min(at_start(), 0.0) + std::min(at_end(), 0.0) < -0.5 * length)
        depth *= 0.5;
    const Vec2 inner_start = start - std::max(at_start(), 0.0) * along, inner_end = end + std::max(at_end(), 0.0) * along;
    const Vec2 outer_start = start - at_start() * along + depth * out, outer_end = end + at_end() * along + depth * out;
    return {inner_end, inner_start, outer_start, outer_end};
}

void add_walls(const CaseDef& def, const Polygon& domain, const std::vector<std::set<Index>>& boundary_edges, double mean_size,
               RockMass& rock)
{
    if (std::ranges::none_of(def.boundaries, needs_wall))
        return;
    std::vector<Problem> problems;
    std::unordered_set<std::string> names;
    for (const RockBlock& block : rock.blocks)
        names.insert(block.name);
    const std::size_t first = rock.blocks.size();
    for (std::size_t i = 0; i < boundary_edges.size(); ++i)
    {
        const BoundaryDef& boundary = def.boundaries[i];
        int number = 0;
        for (const Index edge : needs_wall(boundary) ? boundary_edges[i] : std::set<Index>{})
        {
            const auto e = static_cast<std::size_t>(edge);
            const std::string name = boundary_edges[i].size() == 1 ? boundary.name : boundary.name + "." + std::to_string(++number);
            if (!names.insert(name).second)
                problems.push_back({Problem::Severity::error, "boundary[" + std::to_string(i) + "].name",
                                    "boundary: name = \"" + boundary.name + "\" (a block is called \"" + name +
                                        "\", as its wall would be). Choose another."});
            rock.walls.push_back({{static_cast<Index>(i), domain[e], domain[next(e, domain.size())]}, rock.blocks.size()});
            rock.blocks.push_back(wall_block(name, def.domain.material, wall_behind(domain, e, mean_size)));
        }
    }
    for (const BlockOverlap& overlap : find_overlaps(rock.blocks, first, accepted_overlap))
        if (overlap.a < first)
            problems.push_back(
                {Problem::Severity::error, "boundary[" + std::to_string(rock.walls[overlap.b - first].edge.boundary) + "]",
                 "boundary \"" + rock.blocks[overlap.b].name + "\": its wall, " + text(mean_size) + " m thick, overlaps block \"" +
                     rock.blocks[overlap.a].name + "\" by " + text(overlap.area) +
                     " m2 (a wall stands behind its side, outside of the domain). Move the block, or fix the side."});
    if (!problems.empty())
        throw InputError(std::move(problems));
}
}  // namespace hdem
