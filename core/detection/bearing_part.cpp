#include "core/detection/bearing_part.h"

#include "core/detection/edge_neighbour.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace hdem
{
namespace
{
/// Rings of neighbours around a part that are searched: two, since a part without external edges may lie between two that can bear.
constexpr int rings = 2;

/// Multiple of the depth. An external edge behind which the overlap is deeper is on the other side of the block. (A spike of 37 degrees along a seam lies
/// three times as deep behind the face as behind the seam.)
constexpr double farthest = 3.0;

/// The part itself is the first.
std::vector<Index> parts_around(const Shapes& shapes, Index part)
{
    std::vector<Index> around{part};
    std::size_t at = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (const std::size_t end = around.size(); at < end; ++at)
        {
            const Index of = around[at];
            for (Index e = shapes.vertex_begin[of]; e < shapes.vertex_begin[of + 1]; ++e)
            {
                if (shapes.to_twin[e] == 0)
                    continue;
                const Index beyond = part_of(shapes, shapes.part_block[part], e + shapes.to_twin[e]);
                if (std::ranges::find(around, beyond) == around.end())
                    around.push_back(beyond);
            }
        }
    return around;
}

/// The part beside this one that a corner belongs to, or none: where a pair touches with a corner whose other edge lies flatter on what it touches, or ends beside it, and is of that part. The two edges at
/// a corner are then no choice of this part alone: the one that it has may even stand at right angles to what the corner lies on, or be off it all along but for that corner.
std::optional<EdgeNeighbour> owner_of_corner(const Shapes& shapes, const PartPair& pair, const Facing& facing)
{
    constexpr double steep = -0.7, clearly = 0.05;  // cosines
    constexpr double flat = 0.01;                   // sine
    const Index part = facing.ref_is_a ? pair.b : pair.a;
    const RelativePose& pose = facing.ref_is_a ? pair.b_from_a : pair.a_from_b;
    const Vec2 t = shapes.edge_tangent[facing.ref_edge], start = shapes.vertex[facing.ref_edge];
    const auto along = [&](Index e) { return t.dot(pose.turned(shapes.edge_tangent[e])); };
    const auto across = [&](Index e) { return std::abs(cross(t, pose.turned(shapes.edge_tangent[e]))); };
    const auto seen = [&](Index v) { return Vec2(pose.moved(shapes.vertex[v]) - start); };
    const Index end = shapes.next_vertex(part, facing.inc_edge);
    const double depth = cross(t, seen(facing.inc_edge)), depth_at_end = cross(t, seen(end));
    const EdgeNeighbour other = neighbour_of(shapes, part, facing.inc_edge, depth_at_end > depth);
    if (other.part == part || !is_external(shapes, other.edge))
        return std::nullopt;
    if (along(facing.inc_edge) >= steep)
        return along(other.edge) < along(facing.inc_edge) - clearly ? std::optional(other) : std::nullopt;
    const double from = t.dot(seen(other.edge)), to = t.dot(seen(shapes.next_vertex(other.part, other.edge)));
    const double over = std::min(std::max(from, to), shapes.edge_length[facing.ref_edge]) - std::max(std::min(from, to), 0.0);
    const bool ends_beside = over > -pair.margin && across(other.edge) < flat;
    const bool is_flatter = std::min(depth, depth_at_end) < -pair.margin && (over > pair.margin || ends_beside) &&
                            along(other.edge) < steep && across(other.edge) < 0.5 * across(facing.inc_edge);
    return is_flatter ? std::optional(other) : std::nullopt;
}

/// Does a corner of this pair belong to another part, which overlaps as much with its edge there? Where a spike has entered a block beside a corner at which a seam ends, that part
/// may lie beside the spike, or see the corner as this one's.
bool is_corner_of_another(const Shapes& shapes, const PartPair& pair, const Facing& facing)
{
    const std::optional<EdgeNeighbour> owner = owner_of_corner(shapes, pair, facing);
    if (!owner)
        return false;
    const PartPair other{.a = facing.ref_is_a ? pair.a : owner->part,
                         .b = facing.ref_is_a ? owner->part : pair.b,
                         .motion_a = pair.motion_a,
                         .motion_b = pair.motion_b,
                         .margin = pair.margin,
                         .round_off = pair.round_off};
    const PairScan found = scan_pair(shapes, other);
    if (!found.has_external())
        return false;
    const Facing its_own = choose_facing(shapes, other, found);
    // Where its edge only reaches the end of the one below, both are as deep as the corner, and nothing lies on anything.
    const double its_depth = its_own.length > pair.round_off ? its_own.overlap : -found.external_distance();
    if (std::abs(its_depth - facing.overlap) > pair.margin)
        return its_depth > facing.overlap;
    const Index part = facing.ref_is_a ? pair.b : pair.a;
    const std::optional<EdgeNeighbour> back = its_own.ref_is_a == facing.ref_is_a ? owner_of_corner(shapes, other, its_own)
                                                                                  : std::nullopt;
    return !back || back->part != part || owner->part < part;
}

/// Would the parts of `pair` be apart if the parts around them that `facing` is of were drawn apart? By the least way, out of the edge that faces.
bool are_freed(const Shapes& shapes, const PartPair& pair, const Facing& facing, double tolerance)
{
    const BlockMotion& ref = facing.ref_is_a ? pair.motion_a : pair.motion_b;
    const Vec2 t = shapes.edge_tangent[facing.ref_edge];
    const Vec2 outwards = -turned_left(Vec2(ref.c * t.x() - ref.s * t.y(), ref.s * t.x() + ref.c * t.y()));
    const double way = facing.ref_is_a ? facing.overlap : -facing.overlap;
    BlockMotion b = pair.motion_b;
    b.x += way * outwards.x();
    b.y += way * outwards.y();
    const auto is_beyond = [&](Index part, Index other, const RelativePose& pose)
    {
        for (Index e = shapes.vertex_begin[part]; e < shapes.vertex_begin[part + 1]; ++e)
            if (edge_distance(shapes, e, other, pose).least > -tolerance)
                return true;
        return false;
    };
    return is_beyond(pair.a, pair.b, RelativePose(pair.motion_a, b)) || is_beyond(pair.b, pair.a, RelativePose(b, pair.motion_a));
}
}  // namespace

bool bears(const Shapes& shapes, const PartPair& pair, const PairScan& scan, const Facing& its_facing, double tolerance)
{
    if (is_corner_of_another(shapes, pair, its_facing))
        return false;
    const auto leaves_it = [&](const PairScan& s) { return s.distance() > s.external_distance() + pair.margin + tolerance; };
    const bool leaves = leaves_it(scan);
    // Deeper than what tolerances could make of blocks that lie flat on each other.
    const bool is_deep = scan.external_distance() < -farthest * (pair.margin + tolerance);
    if (!leaves && !is_deep)
        return true;
    if (scan.distance() > -pair.margin)
        return false;
    bool is_deepest = !leaves || scan.external_distance() > farthest * scan.distance();
    const std::vector<Index> around_b = parts_around(shapes, pair.b);
    for (const Index a : parts_around(shapes, pair.a))
        for (const Index b : around_b)
        {
            if (a == pair.a && b == pair.b)
                continue;
            const PartPair other{.a = a,
                                 .b = b,
                                 .motion_a = pair.motion_a,
                                 .motion_b = pair.motion_b,
                                 .margin = pair.margin,
                                 .round_off = pair.round_off};
            const PairScan found = scan_pair(shapes, other);
            const double depth = -found.distance();
            if (!found.has_external() || depth < pair.margin)
                continue;
            const Facing facing = choose_facing(shapes, other, found);
            if (is_corner_of_another(shapes, other, facing))
                continue;  // it does not bear
            const bool is_nearer = leaves || facing.overlap + pair.margin + tolerance < -scan.external_distance();
            if (!leaves_it(found) && facing.overlap > 0.0 && is_nearer && are_freed(shapes, pair, facing, pair.margin + tolerance))
                return false;
            const bool comes_first = a != pair.a ? a < pair.a : b < pair.b;  // of pairs that are equally deep
            if (leaves && leaves_it(found) && (depth > -scan.distance() || (depth == -scan.distance() && comes_first)))
                is_deepest = false;
        }
    return is_deepest;
}
}  // namespace hdem
