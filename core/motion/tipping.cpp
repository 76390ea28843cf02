#include "core/motion/tipping.h"

#include "core/motion/contact_tie.h"

#include <cmath>

namespace hdem
{
namespace
{
/// Of the radius: points so near to each other are one.
constexpr double one_point = 0.01;

/// A closed end of a contact, as the block sees it.
struct Bearing
{
    Vec2 at = {0.0, 0.0};     ///< from the centroid [m]
    Vec2 other = {0.0, 0.0};  ///< the other end of the contact [m]
    Vec2 force = {0.0, 0.0};  ///< on the block [N]
    bool opens = false;       ///< the faces turn away from each other
};

Bearing bearing_of(Index block, Index contact, int end, const Blocks& blocks, const Contacts& contacts)
{
    const EdgeTouch touch = touch_of(contact, blocks, contacts);
    const bool is_ref = contacts.ref[contact] == block;
    const auto place = [&](const TouchPoint& p) -> Vec2
    {
        const double t = is_ref ? p.ref_t : p.inc_t, m = is_ref ? p.ref_m : p.inc_m;
        return {touch.ex * t - touch.ey * m, touch.ey * t + touch.ex * m};
    };
    const double shear = contacts.shear_force(end, contact) + contacts.tilt_force(end, contact),
                 normal = contacts.normal_force(end, contact);
    const Vec2 on_inc(shear * touch.ex + normal * touch.ey, shear * touch.ey - normal * touch.ex);
    return {.at = place(touch.point[end]),
            .other = place(touch.point[1 - end]),
            .force = is_ref ? Vec2(-on_inc) : on_inc,
            .opens = touch.slope * (blocks.motion[contacts.inc[contact]].w - blocks.motion[contacts.ref[contact]].w) > 0.0};
}
}  // namespace

bool tips(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks, const Contacts& contacts,
          const BlockContacts& list)
{
    const double w = blocks.motion[block].w;
    if (!(std::abs(w) * model.radius[block] > rule.speed))
        return false;
    const auto turns_on = [&](const Vec2& at) { return cross(model.gravity, at) * w > 0.0; };
    Index first = no_index;
    Vec2 hinge = Vec2::Zero();
    double moment = 0.0;
    double stuck = 0.0;  // of the forces, more than slides [N]
    bool sticks = false, rolls = false;
    for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
    {
        const Index contact = list.entry[e] / 2;
        if (!do_touch(contact, contacts))
            continue;
        for (int end = 0; end < 2; ++end)
        {
            const Tie tie = tie_of(contact, end, rule.speed, blocks, contacts);
            if (tie == Tie::none)
                continue;
            const Bearing bearing = bearing_of(block, contact, end, blocks, contacts);
            if (!turns_on(bearing.at) || (!bearing.opens && !(!rule.seeks_rest && turns_on(bearing.other))))
                return false;
            if (first == no_index)
                hinge = bearing.at;
            const bool is_apart = first != no_index && (hinge - bearing.at).norm() > one_point * model.radius[block];
            if (is_apart && !(!rule.seeks_rest && first == contact))
                return false;
            rolls = rolls || is_apart;
            first = first == no_index ? contact : first;
            sticks = sticks || tie == Tie::sticks;
            stuck += (tie == Tie::sticks ? 1.0 : -1.0) * bearing.force.norm();
            moment += cross(bearing.at, bearing.force);
        }
    }
    return first != no_index && (rolls ? stuck > 0.0 : sticks || moment * w > 0.0);
}
}  // namespace hdem
