#include "core/contact/spring_power.h"

#include "core/detection/edge_touch.h"

namespace hdem
{
namespace
{
/// Velocities of a contact's points if its blocks moved as given [m/s].
EdgeTouch touch_at_velocities(const Contacts& contacts, Index i, const Blocks& blocks, const std::vector<Triple>& velocity)
{
    BlockMotion ref = blocks.motion[contacts.ref[i]];
    BlockMotion inc = blocks.motion[contacts.inc[i]];
    const auto set = [](BlockMotion& motion, const Triple& v)
    {
        motion.vx = v.x;
        motion.vy = v.y;
        motion.w = v.w;
    };
    set(ref, velocity[contacts.ref[i]]);
    set(inc, velocity[contacts.inc[i]]);
    return touch_edges(contacts.edges(i), ref, inc);
}
}  // namespace

double normal_power(IndexRange range, const Contacts& contacts, const Blocks& blocks, const std::vector<Triple>& velocity)
{
    double power = 0.0;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const bool spring = is_spring(contacts.regime[0][i]) || is_spring(contacts.regime[1][i]);
        if (!spring || !(is_moved(velocity[contacts.ref[i]]) || is_moved(velocity[contacts.inc[i]])))
            continue;
        const EdgeTouch touch = touch_at_velocities(contacts, i, blocks, velocity);
        for (int k = 0; k < 2; ++k)
            if (is_spring(contacts.regime[k][i]))
                power -= contacts.normal_force(k, i) * touch.point[k].v_m;
    }
    return power;
}
}  // namespace hdem
