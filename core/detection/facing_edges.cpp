#include "core/detection/facing_edges.h"

#include "core/detection/edge_touch.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Does an edge lie flat on another, and a second edge at an angle to it that a sliver beside them would have? By the sines of their angles to it.
bool is_flat_beside(double sine, double other_sine)
{
    return std::abs(other_sine) > 2e-3 && std::abs(sine) < 0.25 * std::abs(other_sine);
}

/// External edge of `other` that faces `edge`: of those that end in a vertex which reaches farthest behind it, within `margin`, the one most opposed to it.
/// A straight side may have vertices in its middle: of pieces (almost) in one line it is the one with the longest stretch over the edge, unless one is flat on it
/// and the other leaves room for a sliver between joints of almost the same dip. (Never a steep side just because it lies over the edge and the flat one beside it:
/// a corner on a corner would carry as much as a face.)
Index facing_edge(const Shapes& shapes, Index edge, Index other, const RelativePose& pose, double margin)
{
    const Vec2 t = shapes.edge_tangent[edge];
    const Vec2 start = shapes.vertex[edge];
    const auto depth = [&](Index v) { return cross(t, Vec2(pose.moved(shapes.vertex[v]) - start)); };
    double deepest = -infinity;
    for (Index v = shapes.vertex_begin[other]; v < shapes.vertex_begin[other + 1]; ++v)
        deepest = std::max(deepest, depth(v));
    Index best = no_index;
    double best_length = 0.0, best_along = infinity, best_across = 0.0;
    bool best_deep = false;
    for (Index e = shapes.vertex_begin[other]; e < shapes.vertex_begin[other + 1]; ++e)
    {
        if (!is_external(shapes, e))
            continue;
        const Index end = shapes.next_vertex(other, e);
        const bool deep = std::max(depth(e), depth(end)) >= deepest - margin;
        const double from = t.dot(pose.moved(shapes.vertex[e]) - start);
        const double to = t.dot(pose.moved(shapes.vertex[end]) - start);
        const double length = std::min(std::max(from, to), shapes.edge_length[edge]) - std::max(std::min(from, to), 0.0);
        const Vec2 direction = pose.turned(shapes.edge_tangent[e]);
        const double along = t.dot(direction), across = cross(t, direction);
        const bool same_side = best != no_index && shapes.edge_tangent[e].dot(shapes.edge_tangent[best]) > in_line &&
                               !is_flat_beside(across, best_across) && !is_flat_beside(best_across, across);
        const bool better = deep != best_deep ? deep : (same_side ? length > best_length : along < best_along);
        if (best != no_index && !better)
            continue;
        best = e;
        best_length = length;
        best_along = along;
        best_across = across;
        best_deep = deep;
    }
    return best;
}

/// A side of a block goes on beyond a hollow corner, inside the block: a corner that is pressed into both sides there lies a little beyond the end of each.
/// @return  by how much, before its start and after its end [m]
std::array<double, 2> beyond_hollow_corners(const Shapes& shapes, Index part, Index edge)
{
    constexpr double share = 0.02;  // of its length: more than anything is pressed in
    const double more = share * shapes.edge_length[edge];
    return {shapes.is_reflex[edge] != 0 ? more : 0.0, shapes.is_reflex[shapes.next_vertex(part, edge)] != 0 ? more : 0.0};
}

EdgePair make_edges(const Shapes& shapes, Index ref_part, Index ref_edge, Index inc_part, Index inc_edge)
{
    const auto [before, after] = beyond_hollow_corners(shapes, ref_part, ref_edge);
    const Vec2 t = shapes.edge_tangent[ref_edge];
    const Vec2 start = shapes.vertex[ref_edge];
    const Vec2 p0 = shapes.vertex[inc_edge];
    const Vec2 p1 = shapes.vertex[shapes.next_vertex(inc_part, inc_edge)];
    return {.tx = t.x(),
            .ty = t.y(),
            .start_t = t.dot(start) - before,
            .start_m = cross(t, start),
            .length = before + shapes.edge_length[ref_edge] + after,
            .p0x = p0.x(),
            .p0y = p0.y(),
            .p1x = p1.x(),
            .p1y = p1.y()};
}

Facing face(const Shapes& shapes, const PartPair& pair, bool ref_is_a, Index ref_edge)
{
    const Index inc_part = ref_is_a ? pair.b : pair.a;
    Facing f{.ref_is_a = ref_is_a, .ref_edge = ref_edge};
    f.inc_edge = facing_edge(shapes, ref_edge, inc_part, ref_is_a ? pair.b_from_a : pair.a_from_b, pair.margin);
    f.edges = make_edges(shapes, ref_is_a ? pair.a : pair.b, ref_edge, inc_part, f.inc_edge);
    const BlockMotion& ref = ref_is_a ? pair.motion_a : pair.motion_b;
    const BlockMotion& inc = ref_is_a ? pair.motion_b : pair.motion_a;
    const EdgeView view = view_edges(f.edges, ref, inc);
    const EdgeTouch touch = touch_edges(f.edges, view, ref, inc);
    const auto beyond = beyond_hollow_corners(shapes, ref_is_a ? pair.a : pair.b, ref_edge);
    const double from = touch.point[0].ref_t - f.edges.start_t, to = touch.point[1].ref_t - f.edges.start_t;
    f.length = touch.length > 0.0 ? std::min(to, f.edges.length - beyond[1]) - std::max(from, beyond[0]) : touch.length;
    f.middle = 0.5 * (from + to);
    const TouchPoint& deepest = touch.point[touch.point[1].overlap > touch.point[0].overlap ? 1 : 0];
    f.deepest = deepest.ref_t - f.edges.start_t;
    f.along = deepest.v_t;
    f.approach = deepest.v_m;
    f.slope = touch.slope;
    f.is_deep_at_end = view.m1 > view.m0;
    f.full = std::min(f.edges.length, std::abs(view.t1 - view.t0));
    f.overlap = f.length > pair.round_off ? std::max(touch.point[0].overlap, touch.point[1].overlap) : -infinity;
    return f;
}

/// A hollow corner presses into nothing: where it is the deepest of the incident edge, that edge is the one into which the other block's corner is pressed there.
/// @return  the facing of that edge, if that corner is near the hollow one and none is pressed in far
std::optional<Facing> facing_in_hollow(const Shapes& shapes, const PartPair& pair, const Facing& facing)
{
    const Index part = facing.ref_is_a ? pair.b : pair.a;
    const Index corner = facing.is_deep_at_end ? shapes.next_vertex(part, facing.inc_edge) : facing.inc_edge;
    if (shapes.is_reflex[corner] == 0)
        return std::nullopt;
    const Facing other = face(shapes, pair, !facing.ref_is_a, facing.inc_edge);
    const auto beyond = beyond_hollow_corners(shapes, part, facing.inc_edge);
    const double reach = beyond[facing.is_deep_at_end ? 1 : 0];
    const double to_end = facing.is_deep_at_end ? other.edges.length - other.deepest : other.deepest;
    const bool is_near = to_end < 2.0 * reach && std::abs(other.overlap) < reach && std::abs(facing.overlap) < reach;
    return is_near ? std::optional(other) : std::nullopt;
}

/// Does an edge of one part lie flat on an edge of the other, or has one of them none?
bool are_opposed(const Shapes& shapes, const PartPair& pair, Index edge_a, Index edge_b)
{
    return edge_a == no_index || edge_b == no_index ||
           shapes.edge_tangent[edge_a].dot(pair.b_from_a.turned(shapes.edge_tangent[edge_b])) < opposed;
}

/// The two edges of `facing` do not lie over each other: of the edges whose distance is `best`, the one that does. Edges of an almost straight side
/// are equally far from a corner that nears or enters it, and only one of them is over that corner. While the parts are apart, only pieces of one side change places: of
/// blocks that touch with corners no edge lies over another, and they would pass from one to the next at each search.
Facing better_placed(const Shapes& shapes, const PartPair& pair, const Facing& facing, double best)
{
    Facing deepest = facing;
    const auto may_take = [&](bool on_a, Index e)
    {
        const bool is_same_side = on_a == facing.ref_is_a &&
                                  shapes.edge_tangent[e].dot(shapes.edge_tangent[facing.ref_edge]) > in_line;
        return is_external(shapes, e) && (best < -pair.round_off || is_same_side);
    };
    for (const bool on_a : {true, false})
    {
        const Index part = on_a ? pair.a : pair.b;
        const Index other = on_a ? pair.b : pair.a;
        for (Index e = shapes.vertex_begin[part]; e < shapes.vertex_begin[part + 1]; ++e)
        {
            if (!may_take(on_a, e))
                continue;
            const Distance to_line = edge_distance(shapes, e, other, on_a ? pair.b_from_a : pair.a_from_b);
            if (to_line.least < best - pair.margin || to_line.is_at_seam(pair.margin))
                continue;
            if (const Facing f = face(shapes, pair, on_a, e); f.overlap > deepest.overlap)
                deepest = f;
        }
    }
    return deepest.overlap > facing.overlap + pair.margin ? deepest : facing;
}
}  // namespace

Facing choose_facing(const Shapes& shapes, const PartPair& pair, const PairScan& scan, Index kept)
{
    const auto& [on_a, on_b] = scan.on;
    // Near ties go to the longer edge; at a corner, where the two edges do not lie on each other, ties only.
    const auto length = [&](const Scan& on) { return on.edge != no_index ? shapes.edge_length[on.edge] : 0.0; };
    const double tie = are_opposed(shapes, pair, on_a.edge, on_b.edge) ? pair.margin : pair.round_off;
    const double lead = length(on_a) >= length(on_b) ? tie : -tie;
    bool ref_is_a = on_a.external_distance + lead >= on_b.external_distance;
    Index ref_edge = ref_is_a ? on_a.edge : on_b.edge;
    const double best = scan.external_distance();
    const double kept_distance = std::max(on_a.kept_distance, on_b.kept_distance);
    if (kept != no_index && kept_distance >= best - pair.margin)
    {
        ref_edge = kept;
        ref_is_a = on_a.kept_distance > -infinity;
    }
    const Facing facing = face(shapes, pair, ref_is_a, ref_edge);
    if (const std::optional<Facing> in_hollow = facing_in_hollow(shapes, pair, facing))
        return *in_hollow;
    return facing.overlap < -best - pair.margin ? better_placed(shapes, pair, facing, best) : facing;
}

Facing facing_on(bool part_a, const Shapes& shapes, const PartPair& pair, const PairScan& scan)
{
    return face(shapes, pair, part_a, scan.on[part_a ? 0 : 1].edge);
}
}  // namespace hdem
