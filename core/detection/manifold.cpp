#include "core/detection/manifold.h"

#include "core/detection/bearing_part.h"
#include "core/detection/carried_history.h"
#include "core/detection/corner_beside_corner.h"
#include "core/detection/edge_touch.h"
#include "core/detection/facing_edges.h"

#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
/// Share of the recycling distance where the blocks are near but bear nothing: which side of a corner a block takes shows within that way, and a side that is found late throws it back.
constexpr double share_at_corners = 0.1;

/// How far a vertex may move until features are searched anew [m].
float limit_of_motion(const Model& model, double size, double distance, bool bearing)
{
    const double limit = model.contact.recycling_distance * size;
    const bool is_at_corner = !bearing && std::abs(distance) < 2.0 * limit;
    return static_cast<float>(is_at_corner ? share_at_corners * limit : limit);
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
    const PartPair pair{.a = a,
                        .b = b,
                        .motion_a = motion[block_a],
                        .motion_b = motion[block_b],
                        .margin = margin,
                        .round_off = closed_gap * floor};
    const PairScan scan = scan_pair(shapes, pair, contact.ref_edge);
    if (!scan.has_external())
        return std::numeric_limits<double>::infinity();
    const bool is_pressed = contact.point[0].normal_force + contact.point[1].normal_force > 0.0;
    const bool was_searched = contact.ref_edge != no_index, was_bearing = was_searched && contact.may_bear();
    const bool keeps_edge = was_bearing || !is_sliding(model, pair, size);  // else the nearest counts: a block may hit it
    const Facing nearest = choose_facing(shapes, pair, scan, keeps_edge ? contact.ref_edge : no_index);
    const Facing facing = is_pressed ? nearest : pass_corner(model, blocks, pair, scan, nearest);
    contact.length_floor = floor;
    const bool is_end = is_end_of_a_piece(shapes, pair, facing, was_bearing ? 0.5 * floor : floor);
    const bool bearing = !is_end && !is_corner_beside_corner(model, blocks, pair, facing, was_bearing) &&
                         bears(shapes, pair, scan, facing,
                               4.0 * model.contact.recycling_distance * size);  // holds until the next search
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
    contact.moved_limit = limit_of_motion(model, size, scan.external_distance(), bearing);
    remember_view(motion, contact);
    return scan.distance();
}
}  // namespace hdem
