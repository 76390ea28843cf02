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

Index edge_before(const Shapes& shapes, Index part, Index edge)
{
    return edge > shapes.vertex_begin[part] ? edge - 1 : shapes.vertex_begin[part + 1] - 1;
}

/// Does the block of a part go on deeper than a vertex of that part, along a side that meets there? Only where a seam ends: a part by itself is convex.
/// @param outwards  normal of a line, as seen from the block
bool goes_on_deeper(const Shapes& shapes, Index part, Index v, const Vec2& outwards)
{
    constexpr double flat = 0.02;  // sine
    const Index before = edge_before(shapes, part, v);
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

/// Does part `other` reach behind the line of an external edge only beside that edge, where a seam goes on in line with it? There the block goes on behind the seam, and the edge is no way out.
bool is_beside_at_seam(const Shapes& shapes, Index part, Index edge, Index other, const RelativePose& pose)
{
    const Vec2 t = shapes.edge_tangent[edge], start = shapes.vertex[edge];
    const auto goes_on = [&](Index e) { return !is_external(shapes, e) && shapes.edge_tangent[e].dot(t) > in_line; };
    const bool after_end = goes_on(shapes.next_vertex(part, edge)), before_start = goes_on(edge_before(shapes, part, edge));
    if (!after_end && !before_start)
        return false;
    double from = infinity, to = -infinity;  // along the line, of what reaches behind it
    const auto reach = [&](double along)
    {
        from = std::min(from, along);
        to = std::max(to, along);
    };
    for (Index v = shapes.vertex_begin[other]; v < shapes.vertex_begin[other + 1]; ++v)
    {
        const Vec2 p = pose.moved(shapes.vertex[v]) - start, q = pose.moved(shapes.vertex[shapes.next_vertex(other, v)]) - start;
        const double depth = cross(t, p), next_depth = cross(t, q);
        if (depth > 0.0)
            reach(t.dot(p));
        if ((depth > 0.0) != (next_depth > 0.0))
            reach(t.dot(p) + (t.dot(q) - t.dot(p)) * depth / (depth - next_depth));
    }
    return (after_end && from > shapes.edge_length[edge]) || (before_start && to < 0.0);
}

template <bool hollow>
Scan scan(const Shapes& shapes, Index part, Index other, const RelativePose& pose, Index kept, double seam, double round_off)
{
    Scan scan;
    const bool own_hollow = is_hollow(shapes, part);
    for (Index e = shapes.vertex_begin[part]; e < shapes.vertex_begin[part + 1]; ++e)
    {
        const Distance to_line = distance_of<hollow>(shapes, e, other, pose);
        const double distance = to_line.least;
        const bool external = is_external(shapes, e);
        scan.has_external = scan.has_external || external;
        if (hollow && external && to_line.is_at_seam(seam))
            continue;
        if (external && own_hollow && distance < -seam && is_beside_at_seam(shapes, part, e, other, pose))
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
