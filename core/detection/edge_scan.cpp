#include "core/detection/edge_scan.h"

#include "core/detection/edge_neighbour.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Only blocks of several parts have reflex corners.
bool is_hollow(const Shapes& shapes, Index part)
{
    const Index block = shapes.part_block[part];
    return shapes.part_begin[block + 1] - shapes.part_begin[block] > 1;
}

/// Does the block of a part go on deeper than a vertex of that part, along a side that meets there? Only where a seam ends: a part by itself is convex.
/// @param outwards  normal of a line, as seen from the block
bool goes_on_deeper(const Shapes& shapes, Index part, Index v, const Vec2& outwards)
{
    constexpr double flat = 0.02;  // sine
    const Index before = v > shapes.vertex_begin[part] ? v - 1 : shapes.vertex_begin[part + 1] - 1;
    if (shapes.is_reflex[v] != 0)
        return true;
    if (is_external(shapes, v) && is_external(shapes, before))
        return false;
    const Index next = is_external(shapes, v) ? v : neighbour_of(shapes, part, before, true).edge;
    const Index last = is_external(shapes, before) ? before : neighbour_of(shapes, part, v, false).edge;
    return outwards.dot(shapes.edge_tangent[next]) < -flat || outwards.dot(shapes.edge_tangent[last]) > flat;
}

template <bool hollow>
Distance distance_of(const Shapes& shapes, Index edge, Index other, const RelativePose& pose)
{
    const Vec2 normal = -turned_left(shapes.edge_tangent[edge]);
    // Least of n.(R v + d - p): turn the normal once rather than each vertex.
    const Vec2 seen(pose.c * normal.x() + pose.s * normal.y(), pose.c * normal.y() - pose.s * normal.x());
    const double origin = normal.dot(Vec2(pose.x, pose.y) - shapes.vertex[edge]);
    double least = infinity;
    for (Index v = shapes.vertex_begin[other]; v < shapes.vertex_begin[other + 1]; ++v)
        least = std::min(least, seen.dot(shapes.vertex[v]));
    if (!hollow || least + origin >= 0.0)
        return {least + origin, least + origin};
    double plain = infinity;
    for (Index v = shapes.vertex_begin[other]; v < shapes.vertex_begin[other + 1]; ++v)
        if (const double d = seen.dot(shapes.vertex[v]); d < plain && !goes_on_deeper(shapes, other, v, seen))
            plain = d;
    return {least + origin, plain + origin};
}

template <bool hollow>
Scan scan(const Shapes& shapes, Index part, Index other, const RelativePose& pose, Index kept, double seam, double round_off)
{
    Scan scan;
    for (Index e = shapes.vertex_begin[part]; e < shapes.vertex_begin[part + 1]; ++e)
    {
        const Distance to_line = distance_of<hollow>(shapes, e, other, pose);
        const double distance = to_line.least;
        const bool external = is_external(shapes, e);
        scan.has_external = scan.has_external || external;
        if (hollow && external && to_line.is_at_seam(seam))
            continue;
        scan.distance = std::max(scan.distance, distance);
        if (!external)
        {
            if (distance > scan.internal_distance)
            {
                scan.internal_distance = distance;
                scan.internal_edge = e;
            }
            continue;
        }
        if (e == kept)
            scan.kept_distance = distance;
        const bool longer = scan.edge != no_index && shapes.edge_length[e] > shapes.edge_length[scan.edge];
        if (distance > scan.external_distance + round_off || (distance >= scan.external_distance - round_off && longer))
        {
            scan.external_distance = std::max(scan.external_distance, distance);
            scan.edge = e;
        }
    }
    return scan;
}
}  // namespace

Distance edge_distance(const Shapes& shapes, Index edge, Index other, const RelativePose& pose)
{
    return is_hollow(shapes, other) ? distance_of<true>(shapes, edge, other, pose) : distance_of<false>(shapes, edge, other, pose);
}

PairScan scan_pair(const Shapes& shapes, const PartPair& pair, Index kept)
{
    const auto scan_within = [&](double seam)
    {
        const auto on = [&](Index part, Index other, const RelativePose& pose)
        {
            return is_hollow(shapes, other) ? scan<true>(shapes, part, other, pose, kept, seam, pair.round_off)
                                            : scan<false>(shapes, part, other, pose, kept, seam, pair.round_off);
        };
        return PairScan{{on(pair.a, pair.b, pair.b_from_a), on(pair.b, pair.a, pair.a_from_b)}};
    };
    const PairScan found = scan_within(pair.margin);
    const bool all_at_seams = found.has_external() && found.on[0].edge == no_index && found.on[1].edge == no_index;
    return all_at_seams ? scan_within(infinity) : found;
}
}  // namespace hdem
