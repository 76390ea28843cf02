#include "core/detection/manifold.h"

#include "core/detection/bearing_part.h"
#include "core/detection/carried_history.h"
#include "core/detection/edge_neighbour.h"
#include "core/detection/edge_touch.h"
#include "core/detection/facing_edges.h"

#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
/// Length of the reference edge of a pair that bears nothing: nothing lies over it.
constexpr double no_length = -1.0;

/// Edges that lie over each other by less than this width bear nothing: a tenth of the length floor and what the blocks may move until the next search, or some settlements of the
/// heavier block, at most a hundredth of the smaller one's size.
///
/// A block that slides over the joint between two others is as deep in the second one as its weight presses it in. The side of that joint would hold it, or impulses would
/// throw it back. (Of an edge that is shorter, half must lie over the other: a tip may be as narrow as it likes.)
constexpr double corner_width = 0.1;    // of the length floor
constexpr double settled_corner = 8.0;  // its front edge may be pressed in four times as far, and it may carry another block
constexpr double widest_corner = 1e-2;  // of the size

void remember_view(const std::vector<BlockMotion>& motion, Contact& contact)
{
    const EdgeView v = view_edges(contact.edges, motion[contact.ref], motion[contact.inc]);
    contact.seen = {static_cast<float>(v.t0), static_cast<float>(v.m0), static_cast<float>(v.t1), static_cast<float>(v.m1)};
}
}  // namespace

namespace
{
Index joint_between(const Model& model, Index ref_edge, Index inc_edge, Index ref, Index inc)
{
    const std::vector<std::int32_t>& source = model.shapes.edge_source;
    return model.joints.find(source[ref_edge], source[inc_edge], model.material[ref], model.material[inc]);
}

/// How far the weight of a block presses it into what it lies on [m].
double settlement(const Model& model, const Blocks& blocks, Index block, Index law)
{
    if (!blocks.is_free(block))
        return 0.0;
    return model.mass[block] * model.gravity.norm() / (model.joints.laws[law].normal_stiffness * model.size(block));
}

/// Do the blocks touch with corners only? See corner_width.
bool is_corner_beside_corner(const Model& model, const Blocks& blocks, const PartPair& pair, const Facing& facing)
{
    const Index a = model.shapes.part_block[pair.a], b = model.shapes.part_block[pair.b];
    const double size = std::min(model.size(a), model.size(b));
    const Index law = joint_between(model, facing.ref_edge, facing.inc_edge, facing.ref_is_a ? a : b, facing.ref_is_a ? b : a);
    const double settled = settled_corner * std::max(settlement(model, blocks, a, law), settlement(model, blocks, b, law));
    const double width = std::clamp(settled, (corner_width * model.contact.length_floor + model.contact.recycling_distance) * size,
                                    widest_corner * size);
    if (facing.length >= std::min(width, 0.5 * facing.full))
        return false;
    const Shapes& shapes = model.shapes;
    const Index part = facing.ref_is_a ? pair.a : pair.b;
    const bool at_end = facing.middle > 0.5 * facing.edges.length;
    const Index next = neighbour_of(shapes, part, facing.ref_edge, at_end).edge;
    return shapes.edge_tangent[next].dot(shapes.edge_tangent[facing.ref_edge]) < in_line;  // else a side goes on there
}
}  // namespace

Index joint_of(const Model& model, const Contact& contact)
{
    return joint_between(model, contact.ref_edge, contact.inc_edge, contact.ref, contact.inc);
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
    const PartPair pair{.a = a,
                        .b = b,
                        .motion_a = motion[block_a],
                        .motion_b = motion[block_b],
                        .margin = margin,
                        .round_off = closed_gap * floor};
    const PairScan scan = scan_pair(shapes, pair, contact.ref_edge);
    if (!scan.has_external())
        return std::numeric_limits<double>::infinity();
    const Facing facing = choose_facing(shapes, pair, scan, contact.ref_edge);
    const bool bearing = !is_corner_beside_corner(model, blocks, pair, facing) &&
                         bears(shapes, pair, scan, facing,
                               4.0 * model.contact.recycling_distance * size);  // holds until the next search
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
    return scan.distance();
}
}  // namespace hdem
