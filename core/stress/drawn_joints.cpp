#include "core/stress/drawn_joints.h"

#include "core/detection/manifold.h"
#include "core/stress/insitu_stress.h"

#include <algorithm>

namespace hdem
{
double drawn_preload(const Model& model, Index law, double overlap, double length_floor)
{
    constexpr double rounding = 1e-8;  // of the length floor, which is a thousandth of the block's size
    const bool holds = model.joints.has_memory(law) && model.joints.rows[law].is_bonded && !model.joints.rows[law].begins_broken;
    return holds ? std::max(rounding * length_floor - overlap, 0.0) : 0.0;
}

void join_drawn_blocks(const Model& model, const std::vector<std::uint8_t>& among, State& state)
{
    Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        if (among[contacts.ref[i]] == 0 || among[contacts.inc[i]] == 0)
            continue;
        const BlockMotion& ref = state.blocks.motion[contacts.ref[i]];
        const BlockMotion& inc = state.blocks.motion[contacts.inc[i]];
        const EdgeTouch touch = touch_edges(contacts.edges(i), ref, inc);
        if (!lie_on_each_other(touch, contacts.length_floor(i)))
            continue;
        Contact contact = contacts.get(i);
        contact.law = joint_of(model, contact);
        for (int k = 0; k < 2; ++k)
        {
            PointHistory& point = contact.point[k];
            point.memory = model.joints.has_memory() ? drawn_memory(model.joints.rows[contact.law], 0.0, 0.0) : JointMemory{};
            const double preload = drawn_preload(model, contact.law, touch.point[k].overlap, contacts.length_floor(i));
            point.overlap += preload - point.preload;
            point.preload = preload;
        }
        contacts.put(i, contact);
        if (model.insitu.given)
            lock_in_stress(model, state, i);
    }
}
}  // namespace hdem
