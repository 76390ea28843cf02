#include "core/detection/corner_beside_corner.h"

#include "core/detection/edge_neighbour.h"
#include "core/stage/rules.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double corner_width = 0.1;    // of the length floor
constexpr double settlements = 4.0;     // the front edge may be pressed in four times as far
constexpr double least_load = 2.0;      // weights: the block may carry another one
constexpr double widest_corner = 1e-2;  // of the size
constexpr double steep = 0.36;          // tangent of the angle between two edges: blocks that rock are less inclined
constexpr double least_fall = 1e-4;     // of the size
constexpr double inclined = 0.05;       // tangent of the angle between two edges that do not
constexpr double passes = 0.1;          // of the approach at one side: the approach at the other side is none

/// How far its weight, or what else it bears, presses a block into what it lies on [m].
double settlement(const Model& model, const Blocks& blocks, Index block, Index law, bool by_weight)
{
    const double force = std::max(least_load * model.mass[block] * model.gravity.norm(),
                                  by_weight ? 0.0 : blocks.bearing_force[block]);
    return force / (model.joints.laws[law].normal_stiffness * model.size(block));
}

double least_width(const Model& model, double size)
{
    return (corner_width * model.contact.length_floor + model.contact.recycling_distance) * size;
}

double greatest_width(const Model& model, double size)
{
    return std::max(least_width(model, size), widest_corner * size);
}

double width_of(const Model& model, const Blocks& blocks, Index a, Index b, Index law, bool by_weight)
{
    const double size = std::min(model.size(a), model.size(b));
    if (is_by_impulses(model.contact.method))
        return least_width(model, size);
    const double of_a = settlement(model, blocks, a, law, by_weight), of_b = settlement(model, blocks, b, law, by_weight);
    const double settled = blocks.is_free(a) && blocks.is_free(b) ? std::min(of_a, of_b) : (blocks.is_free(a) ? of_a : of_b);
    return std::clamp(settlements * settled, least_width(model, size), greatest_width(model, size));
}

bool is_narrow(const Facing& facing, double width)
{
    return facing.length < std::min(width, 0.5 * facing.full);
}

double relative_speed(const PartPair& pair)
{
    const double vx = pair.motion_b.vx - pair.motion_a.vx, vy = pair.motion_b.vy - pair.motion_a.vy;
    return std::sqrt(vx * vx + vy * vy);
}

/// @param way  that the blocks go until features are searched again, at least: a corner that is so far away may be there by then [m]
bool is_entered(const Facing& facing, double width, double way)
{
    return std::abs(facing.slope) > steep && facing.overlap < width + way &&
           std::min(facing.deepest, facing.edges.length - facing.deepest) < width + way;
}

/// The edge that meets the reference edge at one of its ends.
struct NextSide
{
    Index edge;
    bool goes_on;  ///< in line with it: one side of the block
    bool falls;    ///< away from the other block; else the corner is hollow
};

NextSide side_beside(const Shapes& shapes, const PartPair& pair, const Facing& facing, bool at_end)
{
    const Index next = neighbour_of(shapes, facing.ref_is_a ? pair.a : pair.b, facing.ref_edge, at_end).edge;
    const Vec2 &side = shapes.edge_tangent[facing.ref_edge], &beside = shapes.edge_tangent[next];
    return {next, beside.dot(side) > in_line, (at_end ? cross(side, beside) : cross(beside, side)) > 0.0};
}

/// Does the edge that meets the reference edge at an end lie flat on one of the two that meet in the corner of the other block?
bool lies_flat_beside(const Shapes& shapes, const PartPair& pair, const Facing& facing, Index next)
{
    const RelativePose& pose = facing.ref_is_a ? pair.b_from_a : pair.a_from_b;
    const Index inc_part = facing.ref_is_a ? pair.b : pair.a;
    const Index other = neighbour_of(shapes, inc_part, facing.inc_edge, facing.is_deep_at_end).edge;
    return std::ranges::any_of(std::array{facing.inc_edge, other}, [&](Index e)
                               { return shapes.edge_tangent[next].dot(pose.turned(shapes.edge_tangent[e])) < opposed; });
}
}  // namespace

bool is_sliding(const Model& model, const PartPair& pair, double size)
{
    const double speed = relative_speed(pair);
    return speed * speed > least_fall * size * model.gravity.norm();
}

bool is_corner_beside_corner(const Model& model, const Blocks& blocks, const PartPair& pair, const Facing& facing, bool has_borne)
{
    const Shapes& shapes = model.shapes;
    const Index a = shapes.part_block[pair.a], b = shapes.part_block[pair.b];
    const double size = std::min(model.size(a), model.size(b));
    const double speed = relative_speed(pair), way = 2.0 * speed * blocks.step.next;
    if (const double most = greatest_width(model, size); !is_narrow(facing, most) && !is_entered(facing, most, way))
        return false;
    const std::vector<std::int32_t>& source = shapes.edge_source;
    const Index law = model.joints.find(source[facing.ref_edge], source[facing.inc_edge], model.material[facing.ref_is_a ? a : b],
                                        model.material[facing.ref_is_a ? b : a]);
    const bool slides = is_sliding(model, pair, size);
    const double width = width_of(model, blocks, a, b, law, has_borne && !slides);
    const bool narrow = is_narrow(facing, width);
    if (!narrow && !is_entered(facing, width, way))
        return false;
    const double place = narrow ? facing.middle : facing.deepest;
    const NextSide next = side_beside(shapes, pair, facing, place > 0.5 * facing.edges.length);
    if (next.goes_on || (slides && !next.falls))
        return false;
    return narrow || (slides && lies_flat_beside(shapes, pair, facing, next.edge));
}

Facing pass_corner(const Model& model, const Blocks& blocks, const PartPair& pair, const PairScan& scan, const Facing& facing)
{
    if (std::abs(facing.slope) < inclined || facing.approach <= 0.0)
        return facing;
    const Shapes& shapes = model.shapes;
    const double size = std::min(model.size(shapes.part_block[pair.a]), model.size(shapes.part_block[pair.b]));
    const double speed = relative_speed(pair);
    const double reach = least_width(model, size) + 2.0 * speed * blocks.step.next;
    const double to_end = facing.along > 0.0 ? facing.edges.length - facing.deepest : facing.deepest;
    const Scan& beside = scan.on[facing.ref_is_a ? 1 : 0];
    if (!is_sliding(model, pair, size) || to_end > reach || facing.overlap > reach * std::abs(facing.slope) ||
        beside.edge == no_index || beside.external_distance < scan.external_distance() - reach)
        return facing;
    if (const NextSide next = side_beside(shapes, pair, facing, facing.along > 0.0); next.goes_on || !next.falls)
        return facing;
    const Facing other = facing_on(!facing.ref_is_a, shapes, pair, scan);
    return other.approach < passes * facing.approach ? other : facing;
}

bool is_end_of_a_piece(const Shapes& shapes, const PartPair& pair, const Facing& facing, double width)
{
    if (facing.length > width || std::abs(facing.slope) > inclined)
        return false;
    const bool at_end = facing.middle > 0.5 * facing.edges.length;
    if (side_beside(shapes, pair, facing, at_end).goes_on)
        return true;
    const Index next = neighbour_of(shapes, facing.ref_is_a ? pair.b : pair.a, facing.inc_edge, at_end).edge;
    return shapes.edge_tangent[next].dot(shapes.edge_tangent[facing.inc_edge]) > in_line;
}
}  // namespace hdem
