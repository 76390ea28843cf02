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
void MovingGroups::look_outside(const View& view)
{
    const auto all = static_cast<Index>(place_.size()), inside = static_cast<Index>(members_.size());
    const auto look = [&](Index block, auto&& take)
    {
        for (Index e = view.list.begin[block]; e < view.list.begin[block + 1]; ++e)
            take(view.list.entry[e] / 2, place_[other_block(block, view.list.entry[e] / 2, view.contacts)]);
    };
    if (2 * inside < all)
        for (Member& member : members_)
            look(member.block,
                 [&](Index contact, Index other)
                 {
                     if (other == no_index)
                         take_outside(member, contact, view);
                 });
    else
        for (Index block = 0; block < all; ++block)
            if (place_[block] == no_index)
                look(block,
                     [&](Index contact, Index other)
                     {
                         if (other != no_index)
                             take_outside(members_[other], contact, view);
                     });
}

void MovingGroups::take_outside(Member& member, Index contact, const View& view)
{
    if (member.held || !do_touch(contact, view.contacts))
        return;
    member.touched = true;
    for (int end = 0; end < 2; ++end)
        member.held = member.held || tie_of(contact, end, view.rule.speed, view.blocks, view.contacts) == Tie::sticks;
}

/// From those that are reached on to all that contacts lead to which let pass.
template <bool MovingGroups::Member::*reached, typename Passes>
void MovingGroups::flood(const View& view, const Passes& passes)
{
    queue_.clear();
    for (Index k = 0; k < static_cast<Index>(members_.size()); ++k)
        if (members_[k].*reached)
            queue_.push_back(k);
    while (!queue_.empty())
    {
        const Index block = members_[queue_.back()].block;
        queue_.pop_back();
        for (Index e = view.list.begin[block]; e < view.list.begin[block + 1]; ++e)
        {
            const Index contact = view.list.entry[e] / 2;
            const Index other = place_[other_block(block, contact, view.contacts)];
            if (other == no_index || members_[other].*reached || !passes(contact))
                continue;
            members_[other].*reached = true;
            queue_.push_back(other);
        }
    }
}

/// All that moves together with a member that is not held, and the joint on which they slide.
void MovingGroups::gather(Index member, const View& view)
{
    const auto number = static_cast<Index>(groups_.size());
    Group group;
    members_[member].group = number;
    queue_.assign(1, member);
    while (!queue_.empty())
    {
        Member& now = members_[queue_.back()];
        const Index block = now.block;
        queue_.pop_back();
        for (Index e = view.list.begin[block]; e < view.list.begin[block + 1]; ++e)
        {
            const Index contact = view.list.entry[e] / 2;
            if (!do_touch(contact, view.contacts))
                continue;
            now.touches = true;
            const Index other = place_[other_block(block, contact, view.contacts)];
            for (int end = 0; end < 2; ++end)
            {
                if (tie_of(contact, end, view.rule.speed, view.blocks, view.contacts) != Tie::slides)
                    continue;
                if (other != no_index)
                {
                    group.rides = group.rides || !are_together(contact, view.rule.speed, view.blocks, view.contacts);
                    continue;
                }
                const double normal = view.contacts.normal_force(end, contact), shear = view.contacts.shear_force(end, contact);
                const double load = normal * normal + shear * shear;
                if (load > group.load || (load == group.load && load > 0.0 && contact < group.contact))
                {
                    group.load = load;
                    group.contact = contact;
                }
            }
            if (other == no_index || members_[other].group != no_index ||
                !are_together(contact, view.rule.speed, view.blocks, view.contacts))
                continue;
            members_[other].group = number;
            group.is_alone = false;
            queue_.push_back(other);
        }
    }
    groups_.push_back(group);
}

void MovingGroups::find_groups(const View& view)
{
    groups_.clear();
    for (Index k = 0; k < static_cast<Index>(members_.size()); ++k)
        if (!members_[k].held && members_[k].group == no_index)
            gather(k, view);
}

/// Adds members that stick to those of the group.
/// @return whether they may tip together: they are not many, and no face bears them at both of its ends. If not, the group is left unfinished.
bool MovingGroups::gather_together(const View& view, std::vector<Index>& group)
{
    constexpr std::size_t most = 64;
    for (std::size_t at = 0; at < group.size(); ++at)
    {
        if (members_[place_[group[at]]].bolted || group.size() > most)
            return false;
        for (Index e = view.list.begin[group[at]]; e < view.list.begin[group[at] + 1]; ++e)
        {
            const Index contact = view.list.entry[e] / 2;
            const Index block = other_block(group[at], contact, view.contacts), other = place_[block];
            if (other != no_index && are_together(contact, view.rule.speed, view.blocks, view.contacts))
            {
                if (members_[other].search == Search::ended)
                    return false;
                if (members_[other].search == Search::to_come)
                    group.push_back(block);
                members_[other].search = Search::goes_on;
            }
            else if (view.contacts.regime[0][contact] != 0 && view.contacts.regime[1][contact] != 0)
                return false;
        }
    }
    return true;
}

/// Members that stick to each other tip together; else single ones may by themselves. Not where rest is sought: fallen blocks rock in groups, too.
void MovingGroups::find_tipping(const Model& model, const View& view)
{
    const auto turns = [&](Index block) { return std::abs(view.blocks.motion[block].w) * model.radius[block] > view.rule.speed; };
    const auto test = [&](const std::vector<Index>& group)
    {
        const bool found = tips(group, model, view.rule, view.blocks, view.contacts, view.list);
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
        bool together = !view.rule.seeks_rest && gather_together(view, group) && group.size() > 1;
        for (const Index block : group)
            members_[place_[block]].search = Search::ended;
        std::ranges::sort(group);
        together = together && test(group);
        for (std::size_t k = 0; k < group.size() && !together; ++k)
            if (!members_[place_[group[k]]].bolted && turns(group[k]))
            {
                single.assign(1, group[k]);
                test(single);
            }
    }
}

void MovingGroups::find(const Model& model, const GroupRule& rule, const std::vector<Index>& fast, const std::vector<Index>& bolted,
                        const Blocks& blocks, const Contacts& contacts, const BlockContacts& list, std::vector<MovingBlock>& moving)
{
    const View view{rule, blocks, contacts, list};
    take_members(fast, blocks.size());
    look_outside(view);
    for (const Index block : bolted)
        if (place_[block] != no_index)
        {
            Member& member = members_[place_[block]];
            member.bolted = member.touched = member.held = true;
        }
    flood<&Member::held>(view, [&](Index contact) { return are_together(contact, rule.speed, blocks, contacts); });
    for (Member& member : members_)
        member.touched = member.touched || member.held;
    flood<&Member::touched>(view, [&](Index contact) { return do_touch(contact, contacts); });
    find_groups(view);
    find_tipping(model, view);
    before_.swap(moving);
    moving.clear();
    for (const Member& member : members_)
    {
        if (member.tips)
        {
            moving.push_back({member.block, FreeMotion::tips, 1.0F, 0.0F});
            continue;
        }
        if (member.held || !member.touches)
            continue;  // (what touches nothing is not damped in any case)
        const Group& group = groups_[member.group];
        const bool slides = group.contact != no_index;
        if (member.touched && !group.rides && (group.is_alone || !slides))
            continue;
        const EdgeTouch touch = slides ? touch_of(group.contact, blocks, contacts) : EdgeTouch();
        const FreeMotion how = !member.touched ? FreeMotion::flies : (slides ? FreeMotion::slides : FreeMotion::tips);
        moving.push_back({member.block, how, static_cast<float>(touch.ex), static_cast<float>(touch.ey)});
    }
    if (rule.seeks_rest)  // elsewhere slow slips are not damped in any case
        dragged_.find(model, rule, fast, bolted, before_, blocks, contacts, list, moving);
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
