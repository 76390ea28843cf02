#include "core/motion/moving_groups.h"

#include "core/motion/contact_tie.h"
#include "core/motion/tipping.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
bool looks_for_groups(std::int64_t cycles_of_stage, bool there_are_some)
{
    constexpr std::int64_t always = 64, often = 16, seldom = 32;
    return cycles_of_stage < always || cycles_of_stage % (there_are_some ? often : seldom) == 0;
}

void MovingGroups::take_members(const std::vector<Index>& fast, Index blocks)
{
    for (const Member& member : members_)
        place_[member.block] = no_index;
    place_.resize(static_cast<std::size_t>(blocks), no_index);
    members_.clear();
    for (const Index block : fast)
    {
        place_[block] = static_cast<Index>(members_.size());
        members_.push_back({.block = block});
    }
}

/// What members touch that is not fast: from the side of which there are fewer.
void MovingGroups::look_outside(const ContactTies& ties)
{
    const auto all = static_cast<Index>(place_.size()), inside = static_cast<Index>(members_.size());
    if (2 * inside < all)
        for (Member& member : members_)
            ties.for_contacts(member.block,
                              [&](Index contact, Index other)
                              {
                                  if (place_[other] == no_index)
                                      take_outside(member, contact, ties);
                              });
    else
        for (Index block = 0; block < all; ++block)
            if (place_[block] == no_index)
                ties.for_contacts(block,
                                  [&](Index contact, Index other)
                                  {
                                      if (place_[other] != no_index)
                                          take_outside(members_[place_[other]], contact, ties);
                                  });
}

void MovingGroups::take_outside(Member& member, Index contact, const ContactTies& ties)
{
    if (member.held || !ties.do_touch(contact))
        return;
    member.touched = true;
    member.held = ties.is_somewhere(Tie::sticks, contact);
}

/// From those that are reached on to all that contacts lead to which let pass. Most are next to one that comes before them in order: so those are taken
/// first, and each looks no further than to the first contact that reaches it.
template <bool MovingGroups::Member::*reached, typename Passes>
void MovingGroups::flood(const ContactTies& ties, const Passes& passes)
{
    const auto reaches = [&](Index contact, Index next)
    {
        const Index other = place_[next];
        return other != no_index && members_[other].*reached && passes(contact);
    };
    left_.clear();
    for (Index k = 0; k < static_cast<Index>(members_.size()); ++k)
        if (!(members_[k].*reached))
        {
            members_[k].*reached = ties.any_contact(members_[k].block, reaches);
            if (!(members_[k].*reached))
                left_.push_back(k);
        }
    for (const Index from : left_)
    {
        if (members_[from].*reached || !ties.any_contact(members_[from].block, reaches))
            continue;
        members_[from].*reached = true;
        queue_.assign(1, from);
        while (!queue_.empty())
        {
            const Index block = members_[queue_.back()].block;
            queue_.pop_back();
            ties.for_contacts(block,
                              [&](Index contact, Index next)
                              {
                                  const Index other = place_[next];
                                  if (other == no_index || members_[other].*reached || !passes(contact))
                                      return;
                                  members_[other].*reached = true;
                                  queue_.push_back(other);
                              });
        }
    }
}

/// A joint of the group that slides, to another member or to the outside.
void MovingGroups::take_joint(Index contact, bool outside, Group& group, const ContactTies& ties)
{
    const Contacts& contacts = ties.contacts;
    for (int end = 0; end < 2; ++end)
    {
        if (ties.at(contact, end) != Tie::slides)
            continue;
        if (!outside)
        {
            group.rides = group.rides || !ties.are_together(contact);
            continue;
        }
        const double normal = contacts.normal_force(end, contact), shear = contacts.shear_force(end, contact);
        const double load = normal * normal + shear * shear;
        if (load > group.load || (load == group.load && load > 0.0 && contact < group.contact))
        {
            group.load = load;
            group.contact = contact;
        }
    }
}

/// Of a joint to the outside that touches or is hardly open: a block that slides on its springs hops, and the joint closes again soon.
void MovingGroups::take_direction(Index contact, const ContactTies& ties)
{
    constexpr double hardly = 1e-3;  // of the distance from the centroid
    const EdgeTouch touch = ties.touch(contact);
    const auto is_near = [](const TouchPoint& p)
    { return p.overlap * std::abs(p.overlap) > -hardly * hardly * (p.ref_t * p.ref_t + p.ref_m * p.ref_m); };
    if (ties.do_touch(contact) || (touch.length > 0.0 && (is_near(touch.point[0]) || is_near(touch.point[1]))))
        along_.emplace_back(touch.ex, touch.ey);
}

/// Do joints lead in another direction than the most loaded one?
/// @pre  the group slides on a joint to the outside
bool MovingGroups::have_directions(const Group& group, const ContactTies& ties) const
{
    constexpr double least_sine = 0.1;
    const EdgeTouch main = ties.touch(group.contact);
    return std::ranges::any_of(along_,
                               [&](const Vec2& along) { return std::abs(main.ex * along.y() - main.ey * along.x()) > least_sine; });
}

/// All that moves together with a member that is not held, and the joint on which they slide.
void MovingGroups::gather(Index member, const ContactTies& ties)
{
    const auto number = static_cast<Index>(groups_.size());
    Group group;
    std::size_t members = 1;
    along_.clear();
    members_[member].group = number;
    queue_.assign(1, member);
    while (!queue_.empty())
    {
        Member& now = members_[queue_.back()];
        queue_.pop_back();
        ties.for_contacts(now.block,
                          [&](Index contact, Index next)
                          {
                              const Index other = place_[next];
                              if (other == no_index)
                                  take_direction(contact, ties);
                              if (!ties.do_touch(contact))
                                  return;
                              now.touches = true;
                              take_joint(contact, other == no_index, group, ties);
                              if (other == no_index || !ties.are_together(contact))
                                  return;
                              const auto& regime = ties.contacts.regime;
                              group.turns = group.turns || (regime[0][contact] == 0) != (regime[1][contact] == 0);
                              if (members_[other].group != no_index)
                                  return;
                              members_[other].group = number;
                              group.is_alone = false;
                              ++members;
                              queue_.push_back(other);
                          });
    }
    constexpr std::size_t most = 8;  // more blocks that hold each other are rock, which is damped
    group.turns = group.contact != no_index && members <= most && (group.turns || have_directions(group, ties));
    groups_.push_back(group);
}

void MovingGroups::find_groups(const ContactTies& ties)
{
    groups_.clear();
    for (Index k = 0; k < static_cast<Index>(members_.size()); ++k)
        if (!members_[k].held && members_[k].group == no_index)
            gather(k, ties);
}

/// Adds members that stick to those of the group.
/// @return whether they may tip together: they are not many, and no face bears them at both of its ends. If not, the group is left unfinished.
bool MovingGroups::gather_together(const ContactTies& ties, std::vector<Index>& group)
{
    const auto bars = [&](Index contact, Index block)
    {
        const Index other = place_[block];
        if (other == no_index || !ties.are_together(contact))
            return ties.contacts.regime[0][contact] != 0 && ties.contacts.regime[1][contact] != 0;
        if (members_[other].search == Search::ended)
            return true;
        if (members_[other].search == Search::to_come)
            group.push_back(block);
        members_[other].search = Search::goes_on;
        return false;
    };
    for (std::size_t at = 0; at < group.size(); ++at)
        if (members_[place_[group[at]]].bolted || group.size() > most_blocks_of_body || ties.any_contact(group[at], bars))
            return false;
    return true;
}

/// Members that stick to each other tip together; else single ones may by themselves. Not where rest is sought: fallen blocks rock in groups, too.
void MovingGroups::find_tipping(const Model& model, const GroupRule& rule, const ContactTies& ties)
{
    const auto turns = [&](Index block) { return std::abs(ties.blocks.motion[block].w) * model.radius[block] > rule.speed; };
    const auto test = [&](const std::vector<Index>& group)
    {
        const bool found = tips(group, model, rule, ties);
        for (const Index block : group)
            members_[place_[block]].tips = found;
        return found;
    };
    std::vector<Index> group, single;
    for (Member& member : members_)
    {
        if (member.search != Search::to_come || !member.touched || !turns(member.block))
            continue;
        member.search = Search::goes_on;
        group.assign(1, member.block);
        bool together = !rule.seeks_rest && gather_together(ties, group) && group.size() > 1;
        for (const Index block : group)
            members_[place_[block]].search = Search::ended;
        if (together)
        {
            std::ranges::sort(group);
            together = test(group);
        }
        for (std::size_t k = 0; k < group.size() && !together; ++k)
            if (!members_[place_[group[k]]].bolted && turns(group[k]))
            {
                single.assign(1, group[k]);
                test(single);
            }
    }
}

/// @pre  it tips, or touches something and is not held
MovingBlock MovingGroups::motion_of(const Member& member, const ContactTies& ties) const
{
    if (member.tips)
        return {member.block, FreeMotion::tips, 1.0F, 0.0F};
    const Index contact = groups_[member.group].contact;
    const bool slides = contact != no_index && !groups_[member.group].turns;
    const EdgeTouch touch = slides ? ties.touch(contact) : EdgeTouch();
    const FreeMotion how = !member.touched ? FreeMotion::flies : (slides ? FreeMotion::slides : FreeMotion::tips);
    return {member.block, how, static_cast<float>(touch.ex), static_cast<float>(touch.ey)};
}

void MovingGroups::find(const Model& model, const GroupRule& rule, const std::vector<Index>& fast, const std::vector<Index>& bolted,
                        const ContactTies& ties, std::vector<MovingBlock>& moving)
{
    take_members(fast, ties.blocks.size());
    look_outside(ties);
    for (const Index block : bolted)
        if (place_[block] != no_index)
        {
            Member& member = members_[place_[block]];
            member.bolted = member.touched = member.held = true;
        }
    flood<&Member::held>(ties, [&](Index contact) { return ties.are_together(contact); });
    for (Member& member : members_)
        member.touched = member.touched || member.held;
    flood<&Member::touched>(ties, [&](Index contact) { return ties.do_touch(contact); });
    find_groups(ties);
    find_tipping(model, rule, ties);
    before_.swap(moving);
    moving.clear();
    const auto is_free = [&](const Member& member)
    {
        if (member.held || !member.touches)
            return false;  // (what touches nothing is not damped in any case)
        const Group& group = groups_[member.group];
        return !member.touched || group.rides || group.turns || (!group.is_alone && group.contact != no_index);
    };
    for (const Member& member : members_)
        if (member.tips || is_free(member))
            moving.push_back(motion_of(member, ties));
    if (rule.seeks_rest)  // elsewhere slow slips are not damped in any case
        dragged_.find(model, rule, fast, bolted, before_, ties, moving);
}

void mark_moving(IndexRange range, const std::vector<MovingBlock>& moving, Blocks& blocks)
{
    for (auto at = std::ranges::lower_bound(moving, range.begin, {}, &MovingBlock::block);
         at != moving.end() && at->block < range.end; ++at)
    {
        BlockForce& force = blocks.force[at->block];
        if (force.contacts == 0)
            continue;  // gone
        force.reserve = 0.0;
        force.t_x = at->t_x;
        force.t_y = at->t_y;
        force.mobilised = at->how == FreeMotion::slides ? 1.0F : -1.0F;  // -1: as if no joint bore it, nothing damps it
    }
}
}  // namespace hdem
