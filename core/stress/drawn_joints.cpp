#include "core/stress/drawn_joints.h"

#include "core/detection/manifold.h"
#include "core/stress/insitu_stress.h"

namespace hdem
{
void join_drawn_blocks(const Model& model, const std::vector<std::uint8_t>& among, State& state)
{
    Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        if (among[contacts.ref[i]] == 0 || among[contacts.inc[i]] == 0)
            continue;
        const BlockMotion& ref = state.blocks.motion[contacts.ref[i]];
        const BlockMotion& inc = state.blocks.motion[contacts.inc[i]];
        if (!lie_on_each_other(touch_edges(contacts.edges(i), ref, inc), contacts.length_floor(i)))
            continue;
        Contact contact = contacts.get(i);
        contact.law = joint_of(model, contact);
        for (PointHistory& point : contact.point)
            point.memory = model.joints.has_memory() ? drawn_memory(model.joints.rows[contact.law], 0.0, 0.0) : JointMemory{};
        contacts.put(i, contact);
        if (model.insitu.given)
            lock_in_stress(model, state, i);
    }
}
}  // namespace hdem
