#include "core/detection/manifold.h"

#include "core/detection/carried_history.h"
#include "core/detection/edge_scan.h"
#include "core/detection/edge_touch.h"

#include <array>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cosine of the angle between two pieces of one side.
constexpr double in_line = 0.999;

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

EdgePair make_edges(const Shapes& shapes, Index ref_edge, Index inc_part, Index inc_edge)
{
    const Vec2 t = shapes.edge_tangent[ref_edge];
    const Vec2 start = shapes.vertex[ref_edge];
    const Vec2 p0 = shapes.vertex[inc_edge];
    const Vec2 p1 = shapes.vertex[shapes.next_vertex(inc_part, inc_edge)];
    return {.tx = t.x(),
            .ty = t.y(),
            .start_t = t.dot(start),
            .start_m = cross(t, start),
            .length = shapes.edge_length[ref_edge],
            .p0x = p0.x(),
            .p0y = p0.y(),
            .p1x = p1.x(),
            .p1y = p1.y()};
}

/// Two parts of a contact, and each block as seen from the other.
struct Pair
{
    Index a, b;
    const BlockMotion& motion_a;
    const BlockMotion& motion_b;
    double margin;  ///< distances that differ by less are equal [m]
    RelativePose b_from_a{motion_a, motion_b};
    RelativePose a_from_b{motion_b, motion_a};
};

/// A reference edge with the edge that faces it.
struct Facing
{
    bool ref_is_a;
    Index ref_edge, inc_edge;
    EdgePair edges;
    double overlap;  ///< greatest where they face each other; -infinity: beside each other [m]
};

Facing face(const Shapes& shapes, const Pair& pair, bool ref_is_a, Index ref_edge)
{
    const Index inc_part = ref_is_a ? pair.b : pair.a;
    Facing f{.ref_is_a = ref_is_a, .ref_edge = ref_edge};
    f.inc_edge = facing_edge(shapes, ref_edge, inc_part, ref_is_a ? pair.b_from_a : pair.a_from_b, pair.margin);
    f.edges = make_edges(shapes, ref_edge, inc_part, f.inc_edge);
    const BlockMotion& ref = ref_is_a ? pair.motion_a : pair.motion_b;
    const BlockMotion& inc = ref_is_a ? pair.motion_b : pair.motion_a;
    const EdgeTouch touch = touch_edges(f.edges, ref, inc);
    f.overlap = touch.length > 0.0 ? std::max(touch.point[0].overlap, touch.point[1].overlap) : -infinity;
    return f;
}

/// The two edges of `facing` do not lie over each other: of the edges whose distance is `best`, the one that does. Edges of an almost straight side
/// are equally far from a corner that nears or enters it, and only one of them is over that corner. While the parts are apart, only pieces of one side change places: of
/// blocks that touch with corners no edge lies over another, and they would pass from one to the next at each search.
Facing better_placed(const Shapes& shapes, const Pair& pair, const Facing& facing, double best)
{
    Facing deepest = facing;
    const auto may_take = [&](bool on_a, Index e)
    {
        const bool is_same_side = on_a == facing.ref_is_a &&
                                  shapes.edge_tangent[e].dot(shapes.edge_tangent[facing.ref_edge]) > in_line;
        return is_external(shapes, e) && (best < 0.0 || is_same_side);
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

/// Length of the reference edge of a pair that bears nothing: nothing lies over it.
constexpr double no_length = -1.0;

/// Is the pair nearer to being apart across an internal edge than across any external one? Then what one block has of the other lies in the part beyond that edge, and
/// that part bears. Here an external edge on the far side of the block may seem to be pressed, by as much as the block is thick: behind a thin ear a neighbour would be
/// shot away by it. Until the next search the answer must hold.
bool bears(double distance, double external_distance, double margin, double recycling)
{
    return distance <= external_distance + margin + 4.0 * recycling;
}

void remember_view(const std::vector<BlockMotion>& motion, Contact& contact)
{
    const EdgeView v = view_edges(contact.edges, motion[contact.ref], motion[contact.inc]);
    contact.seen = {static_cast<float>(v.t0), static_cast<float>(v.m0), static_cast<float>(v.t1), static_cast<float>(v.m1)};
}
}  // namespace

Index joint_of(const Model& model, const Contact& contact)
{
    const std::vector<std::int32_t>& source = model.shapes.edge_source;
    return model.joints.find(source[contact.ref_edge], source[contact.inc_edge], model.material[contact.ref],
                             model.material[contact.inc]);
}

double find_features(const Model& model, const Blocks& blocks, Contact& contact)
{
    const std::vector<BlockMotion>& motion = blocks.motion;
    const Shapes& shapes = model.shapes;
    const Index a = contact.part_a;
    const Index b = contact.part_b;
    const Index block_a = shapes.part_block[a];
    const Index block_b = shapes.part_block[b];
    const double size = std::min(model.size(block_a), model.size(block_b));
    const double floor = model.contact.length_floor * size;
    const double margin = 0.1 * floor;
    const Pair pair{.a = a, .b = b, .motion_a = motion[block_a], .motion_b = motion[block_b], .margin = margin};
    const auto scan = [&](double seam)
    {
        return std::array{scan_edges(shapes, a, b, pair.b_from_a, contact.ref_edge, seam),
                          scan_edges(shapes, b, a, pair.a_from_b, contact.ref_edge, seam)};
    };
    std::array<Scan, 2> scans = scan(margin);
    if (!scans[0].has_external || !scans[1].has_external)
        return infinity;
    if (scans[0].edge == no_index && scans[1].edge == no_index)  // all at seams
        scans = scan(infinity);
    const auto& [on_a, on_b] = scans;
    const double distance = std::max(on_a.distance, on_b.distance);

    // Near ties go to the longer edge.
    const auto length = [&](const Scan& on) { return on.edge != no_index ? shapes.edge_length[on.edge] : 0.0; };
    const double lead = length(on_a) >= length(on_b) ? margin : -margin;
    bool ref_is_a = on_a.external_distance + lead >= on_b.external_distance;
    Index ref_edge = ref_is_a ? on_a.edge : on_b.edge;
    const double best = std::max(on_a.external_distance, on_b.external_distance);
    const double kept = std::max(on_a.kept_distance, on_b.kept_distance);
    if (contact.ref_edge != no_index && kept >= best - margin)
    {
        ref_edge = contact.ref_edge;
        ref_is_a = on_a.kept_distance > -infinity;
    }
    Facing facing = face(shapes, pair, ref_is_a, ref_edge);
    if (facing.overlap < -best - margin)
        facing = better_placed(shapes, pair, facing, best);

    const bool bearing = bears(distance, best, margin, model.contact.recycling_distance * size);
    const bool was_searched = contact.ref_edge != no_index, was_bearing = was_searched && contact.edges.length > no_length;
    if (facing.ref_edge != contact.ref_edge || facing.inc_edge != contact.inc_edge || bearing != was_bearing)
    {
        const Contact old = contact;
        contact.ref = facing.ref_is_a ? block_a : block_b;
        contact.inc = facing.ref_is_a ? block_b : block_a;
        contact.swapped = !facing.ref_is_a;
        contact.ref_edge = facing.ref_edge;
        contact.inc_edge = facing.inc_edge;
        contact.edges = facing.edges;
        if (!bearing)
            contact.edges.length = no_length;
        contact.length_floor = floor;
        contact.moved_limit = static_cast<float>(model.contact.recycling_distance * size);
        const bool goes_on = bearing && was_bearing && carry_history(motion, old, contact);
        if (!bearing || !was_bearing)
            contact.point = {};
        const JointTable& joints = model.joints;
        const Index law = joint_of(model, contact);
        const bool is_bonded = goes_on && joints.unbonded_of(old.law) != old.law;
        contact.law = is_bonded ? law : joints.unbonded_of(law);
        if (joints.has_memory() && old.law != contact.law)
            for (PointHistory& point : contact.point)
                point.memory = {};
        start_points(motion, blocks.step.last, contact);
        if (was_searched)
            limit_energy(model.joints, old, contact);
    }
    remember_view(motion, contact);
    return distance;
}
}  // namespace hdem
