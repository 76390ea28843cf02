#include "core/rock/model_blocks.h"

#include "core/geometry/reflex_vertices.h"
#include "core/geometry/smallest_rectangle.h"
#include "core/geometry/space_curve.h"
#include "core/geometry/twin_edges.h"
#include "core/rock/resolve_names.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace hdem
{
namespace
{
BlockMoments block_moments(const RockBlock& block)
{
    std::vector<AreaMoments> parts;
    for (const ConvexPart& part : block.parts)
        parts.push_back(area_moments(part.vertices));
    BlockMoments moments{combined(parts), 0.0};
    for (const ConvexPart& part : block.parts)
        for (const Vec2& v : part.vertices)
            moments.radius = std::max(moments.radius, (v - moments.of.centroid).norm());
    return moments;
}

Box bounding_box_of(std::span<const RockBlock> blocks)
{
    Box box = bounding_box(blocks.front().parts.front().vertices);
    for (const RockBlock& block : blocks)
        for (const ConvexPart& part : block.parts)
        {
            const Box b = bounding_box(part.vertices);
            box = {box.low.cwiseMin(b.low), box.high.cwiseMax(b.high)};
        }
    return box;
}

/// A model far from the user's origin would lose digits of every centroid.
void move_blocks(RockMass& rock, const Vec2& way)
{
    const auto move = [&](SideEdge& edge)
    {
        edge.from += way;
        edge.to += way;
    };
    for (RockBlock& block : rock.blocks)
    {
        for (ConvexPart& part : block.parts)
            for (Vec2& vertex : part.vertices)
                vertex += way;
        std::ranges::for_each(block.sides, move);
    }
    for (RockWall& wall : rock.walls)
        move(wall.edge);
}

void add_part(Shapes& shapes, const ConvexPart& part, const Vec2& centroid, Index block)
{
    const std::size_t n = part.vertices.size();
    Vec2 low = part.vertices[0] - centroid, high = low;
    for (std::size_t i = 0; i < n; ++i)
    {
        const Vec2 v = part.vertices[i] - centroid;
        const Vec2 edge = part.vertices[next(i, n)] - part.vertices[i];
        shapes.vertex.push_back(v);
        shapes.edge_length.push_back(edge.norm());
        shapes.edge_tangent.push_back(edge / edge.norm());
        shapes.edge_source.push_back(part.source[i]);
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
    }
    shapes.part_block.push_back(block);
    shapes.vertex_begin.push_back(static_cast<Index>(shapes.vertex.size()));
    shapes.part_centre.push_back(0.5 * (low + high));
    shapes.part_radius.push_back(0.5 * (high - low).norm());
}

/// @param density  0 of a wall, which nothing but its side moves
void add_block(Model& model, const RockBlock& block, const BlockMoments& moments, double density, Index material)
{
    const Index number = model.blocks();
    model.name.push_back(block.name);
    model.material.push_back(material);
    model.excavation.push_back(block.excavation);
    model.area.push_back(moments.of.area);
    model.mass.push_back(density * moments.of.area);
    model.inertia.push_back(density * moments.of.polar);
    model.full_inertia.push_back(
        density > 0.0 ? BlockInertia{1.0 / model.mass.back(), 1.0 / model.mass.back(), 1.0 / model.inertia.back(), 0.0}
                      : BlockInertia{});
    model.radius.push_back(moments.radius);
    for (const ConvexPart& part : block.parts)
        add_part(model.shapes, part, moments.of.centroid, number);
    std::ranges::copy(reflex_vertices(block.parts), std::back_inserter(model.shapes.is_reflex));
    std::ranges::copy(twin_edges(block.parts), std::back_inserter(model.shapes.to_twin));
    model.shapes.part_begin.push_back(model.shapes.parts());
}
}  // namespace

std::span<const RockBlock> rock_of(const RockMass& rock)
{
    return {rock.blocks.data(), rock.blocks.size() - rock.walls.size()};
}

PlacedRock place_rock(RockMass& rock, Model& model)
{
    PlacedRock placed;
    Box& box = placed.box;
    box = bounding_box_of(rock_of(rock));
    // A whole number of metres, so that subtracting it is exact for coordinates of up to 1e9 m given to a micrometre.
    model.origin = (0.5 * (box.low + box.high)).array().round();
    model.centre = 0.5 * (box.low + box.high) - model.origin;
    placed.extent = box.high - box.low;
    placed.origin = model.origin;
    if (model.origin.norm() > placed.extent.norm())
    {
        move_blocks(rock, -model.origin);
        box = {box.low - model.origin, box.high - model.origin};
        placed.origin = {0.0, 0.0};
    }
    placed.moments.reserve(rock.blocks.size());
    for (const RockBlock& block : rock.blocks)
        placed.moments.push_back(block_moments(block));
    return placed;
}

double extent_along(const Vec2& direction, const RockMass& rock, const PlacedRock& placed)
{
    if (direction.isZero(0.0))
        return 0.0;
    const Vec2 along = direction / direction.norm();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const RockBlock& block : rock_of(rock))
        for (const ConvexPart& part : block.parts)
            for (const Vec2& vertex : part.vertices)
            {
                low = std::min(low, vertex.dot(along));
                high = std::max(high, vertex.dot(along));
            }
    const double origin = placed.origin.dot(along);
    return (high - origin) - (low - origin);
}

void add_blocks(const CaseDef& def, const RockMass& rock, const PlacedRock& placed, Model& model)
{
    std::vector<Vec2> centroids;
    for (const BlockMoments& block : placed.moments)
        centroids.push_back(block.of.centroid);
    const std::vector<Index> order = curve_order(centroids, placed.box);
    const std::size_t rock_blocks = rock_of(rock).size();
    model.shapes.part_begin.push_back(0);
    model.shapes.vertex_begin.push_back(0);
    double total_area = 0.0;
    for (const Index user : order)
    {
        const Index material = material_number(def, rock.blocks[user].material);
        const bool is_rock = static_cast<std::size_t>(user) < rock_blocks;
        add_block(model, rock.blocks[user], placed.moments[user], is_rock ? def.materials[material].density : 0.0, material);
        total_area += is_rock ? placed.moments[user].of.area : 0.0;
    }
    model.mean_size = std::sqrt(total_area / static_cast<double>(rock_blocks));
    model.user_number = order;
    model.slot_of_user.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        model.slot_of_user[order[i]] = static_cast<Index>(i);
}

void add_initial_state(const RockMass& rock, const PlacedRock& placed, const Model& model, State& state)
{
    Blocks& blocks = state.blocks;
    const auto n = static_cast<std::size_t>(model.blocks());
    blocks.motion.resize(n);
    blocks.force.resize(n);
    blocks.inertia.resize(n);
    blocks.stable_step.assign(n, 0.0);
    blocks.bearing_force.assign(n, 0.0);
    blocks.rest.assign(n, 0);
    blocks.margin.assign(n, model.contact.skin * model.mean_size);
    blocks.present.assign(n, 1);
    for (Index i = 0; i < model.blocks(); ++i)
    {
        const RockBlock& from = rock.blocks[model.user_number[i]];
        const Vec2 at = placed.moments[model.user_number[i]].of.centroid - placed.origin;
        blocks.motion[i] = {.x = at.x(), .y = at.y(), .vx = from.velocity.x(), .vy = from.velocity.y(), .w = from.angular_velocity};
        blocks.inertia[i] = model.full_inertia[i];
        if (from.fix_x)
            blocks.inertia[i].inverse_mass_x = 0.0;
        if (from.fix_y)
            blocks.inertia[i].inverse_mass_y = 0.0;
        if (from.fix_rotation)
            blocks.inertia[i].inverse_inertia = 0.0;
        blocks.reference_position.push_back(at);
        blocks.reference_angle.push_back(0.0);
    }
}

double size_ratio(const RockMass& rock, const PlacedRock& placed, double mean_size)
{
    SmallestRectangle around;
    for (const RockBlock& block : rock_of(rock))
        for (const ConvexPart& part : block.parts)
        {
            std::vector<Vec2> points = part.vertices;
            for (Vec2& point : points)
                point -= placed.origin;
            around.add(points);
        }
    return around.area() / (mean_size * mean_size);
}
}  // namespace hdem
