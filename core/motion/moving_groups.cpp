#include "core/motion/moving_groups.h"

#include "core/detection/edge_touch.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
bool is_unbound(const BlockInertia& inertia)
{
    return inertia.inverse_mass_x > 0.0 && inertia.inverse_mass_y > 0.0 && inertia.inverse_inertia > 0.0;
}

bool is_fast(Index block, const Model& model, double speed, const Blocks& blocks)
{
    const BlockMotion& m = blocks.motion[block];
    const double rim = model.radius[block] * m.w;
    return m.vx * m.vx + m.vy * m.vy + rim * rim > speed * speed;
}

/// How a closed contact point ties its blocks.
enum class Tie
{
    none,  ///< bears nothing
    sticks,
    slides
};

/// @param touch  asked for where it is needed only: it is dear
template <typename Touch>
Tie tie_of(Index contact, int end, const Contacts& contacts, const Touch& touch, double speed)
{
    const std::uint8_t regime = contacts.regime[end][contact];
    if (regime == static_cast<std::uint8_t>(Regime::impulse))
        return std::abs(touch().point[end].v_t) > speed ? Tie::slides : Tie::sticks;
    if (contacts.normal_force(end, contact) == 0.0 && contacts.shear_force(end, contact) == 0.0)
        return Tie::none;
    return regime == static_cast<std::uint8_t>(Regime::slip) ? Tie::slides : Tie::sticks;
}
}  // namespace

void find_fast(IndexRange range, const Model& model, const GroupRule& rule, const Blocks& blocks, std::vector<Index>& fast)
{
    for (Index b = range.begin; b < range.end; ++b)
        if (is_fast(b, model, rule.speed, blocks) && blocks.present[b] != 0 && is_unbound(blocks.inertia[b]))
            fast.push_back(b);
}

Index MovingGroups::root(Index member, Index Member::*parent)
{
    while (members_[member].*parent != member)
        member = members_[member].*parent = members_[members_[member].*parent].*parent;
    return member;
}

void MovingGroups::join(Index a, Index b, Index Member::*parent)
{
    const Index first = root(a, parent), second = root(b, parent);
    members_[std::max(first, second)].*parent = std::min(first, second);
}

void MovingGroups::look_at(Index member, Index contact, const GroupRule& rule, const Blocks& blocks, const Contacts& contacts)
{
    const Index ref = contacts.ref[contact], inc = contacts.inc[contact];
    Member& me = members_[member];
    const Index other = place_[ref == me.block ? inc : ref];
    if (other != no_index && other < member)
        return;  // seen from there
    if (contacts.regime[0][contact] == 0 && contacts.regime[1][contact] == 0)
        return;
    const auto touch = [&] { return touch_edges(contacts.edges(contact), blocks.motion[ref], blocks.motion[inc]); };
    for (int end = 0; end < 2; ++end)
    {
        if (contacts.regime[end][contact] == 0)
            continue;
        const Tie tie = tie_of(contact, end, contacts, touch, rule.speed);
        if (other == no_index)
        {
            me.touches = true;
            me.is_held = me.is_held || tie == Tie::sticks;
        }
        else
        {
            join(member, other, &Member::touching);
            if (tie != Tie::slides)
            {
                join(member, other, &Member::together);
                continue;
            }
        }
        if (tie != Tie::slides)
            continue;
        const double normal = contacts.normal_force(end, contact), shear = contacts.shear_force(end, contact);
        const EdgeTouch at_joint = touch();
        const Joint joint{.load = normal * normal + shear * shear, .t_x = at_joint.ex, .t_y = at_joint.ey};
        for (const Index at : {member, other})
            if (at != no_index && joint.load > members_[at].joint.load)
                members_[at].joint = joint;
    }
}

/// What is known of the members becomes known of the groups, at their roots.
void MovingGroups::gather()
{
    for (Index k = 0; k < static_cast<Index>(members_.size()); ++k)
    {
        Member& member = members_[k];
        Member& cluster = members_[root(k, &Member::touching)];
        cluster.touches = cluster.touches || member.touches;
        const Index first = root(k, &Member::together);
        if (first == k)
            continue;
        Member& group = members_[first];
        group.is_alone = member.is_alone = false;
        group.is_held = group.is_held || member.is_held;
        if (member.joint.load > group.joint.load)
            group.joint = member.joint;
    }
}

void MovingGroups::choose(std::vector<MovingBlock>& moving)
{
    moving.clear();
    for (Index k = 0; k < static_cast<Index>(members_.size()); ++k)
    {
        const Member& group = members_[root(k, &Member::together)];
        const bool flies = !members_[root(k, &Member::touching)].touches;
        if (!flies && (group.is_alone || group.is_held || !group.joint.is_there()))
            continue;
        moving.push_back({members_[k].block, flies, static_cast<float>(group.joint.t_x), static_cast<float>(group.joint.t_y)});
    }
}

void MovingGroups::find(const GroupRule& rule, const std::vector<Index>& fast, const std::vector<Index>& bolted,
                        const Blocks& blocks, const Contacts& contacts, const BlockContacts& list, std::vector<MovingBlock>& moving)
{
    for (const Member& member : members_)
        place_[member.block] = no_index;
    place_.resize(static_cast<std::size_t>(blocks.size()), no_index);
    members_.clear();
    for (const Index block : fast)
    {
        const auto at = static_cast<Index>(members_.size());
        place_[block] = at;
        members_.push_back({.block = block, .touching = at, .together = at});
    }
    for (const Index block : bolted)
        if (place_[block] != no_index)
            members_[place_[block]].touches = members_[place_[block]].is_held = true;
    for (Index k = 0; k < static_cast<Index>(members_.size()); ++k)
        for (Index e = list.begin[members_[k].block]; e < list.begin[members_[k].block + 1]; ++e)
            look_at(k, list.entry[e] / 2, rule, blocks, contacts);
    gather();
    choose(moving);
}

void mark_moving(IndexRange range, const Model& model, const GroupRule& rule, const std::vector<MovingBlock>& moving,
                 Blocks& blocks)
{
    for (auto at = std::ranges::lower_bound(moving, range.begin, {}, &MovingBlock::block);
         at != moving.end() && at->block < range.end; ++at)
    {
        BlockForce& force = blocks.force[at->block];
        if (force.contacts == 0 || !is_fast(at->block, model, rule.speed, blocks))
            continue;  // what touches nothing is not damped in any case
        force.reserve = 0.0;
        force.t_x = at->t_x;
        force.t_y = at->t_y;
        if (!at->flies)
            continue;
        const double size = std::hypot(force.x, force.y);
        force.mobilised = 1.0F;
        force.t_x = size > 0.0 ? static_cast<float>(force.x / size) : 1.0F;  // across this there is no force to be damped
        force.t_y = size > 0.0 ? static_cast<float>(force.y / size) : 0.0F;
    }
}
}  // namespace hdem
