#include "core/motion/dragged_blocks.h"

#include "core/motion/contact_tie.h"

#include <algorithm>
#include <iterator>
#include <ranges>

namespace hdem
{
namespace
{
/// Larger groups are rock, and held.
constexpr std::size_t most_dragged = 64;

/// Of the speed of fast blocks: a dragged block that is slower has stopped. Undamped, its springs would swing on for ever.
constexpr double share_of_stopped = 0.05;

/// Of all contacts of a block.
template <typename Take>
void for_contacts(Index block, const BlockContacts& list, const Take& take)
{
    for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
        take(list.entry[e] / 2);
}
}  // namespace

bool DraggedBlocks::is_slow(Index block, const View& view)
{
    return view.blocks.present[block] != 0 && is_unbound(view.blocks.inertia[block]) &&
           !is_fast(block, view.model, view.rule, view.blocks);
}

bool DraggedBlocks::is_somewhere(Tie tie, Index contact, const View& view)
{
    return tie_of(contact, 0, view.rule.speed, view.blocks, view.contacts) == tie ||
           tie_of(contact, 1, view.rule.speed, view.blocks, view.contacts) == tie;
}

void DraggedBlocks::set(Index block, Mark mark)
{
    if (mark_[block] == Mark::unknown)
        marked_.push_back(block);
    mark_[block] = mark;
}

/// Adds the blocks that stick to this one to its group.
bool DraggedBlocks::is_held(Index block, const View& view)
{
    bool held = false;
    for_contacts(block, view.list,
                 [&](Index contact)
                 {
                     if (held || !is_somewhere(Tie::sticks, contact, view))
                         return;
                     const Index other = other_block(block, contact, view.contacts);
                     if (!is_unbound(view.blocks.inertia[other]) || mark_[other] == Mark::held)
                         held = true;
                     else if (mark_[other] == Mark::unknown)
                     {
                         set(other, Mark::searched);
                         group_.push_back(other);
                     }
                 });
    return held;
}

void DraggedBlocks::search_from(Index seed, const View& view)
{
    if (mark_[seed] != Mark::unknown)
        return;
    set(seed, Mark::searched);
    group_.assign(1, seed);
    bool held = false;
    for (std::size_t at = 0; at < group_.size() && !held; ++at)
        held = is_held(group_[at], view) || group_.size() > most_dragged;
    bool slides = false;  // what only bounces is not pushed along
    for (const Index block : group_)
        for_contacts(block, view.list, [&](Index contact) { slides = slides || is_somewhere(Tie::slides, contact, view); });
    held = held || !slides;
    for (const Index block : group_)
        set(block, held ? Mark::held : Mark::dragged);
}

void DraggedBlocks::find(const Model& model, const GroupRule& rule, const std::vector<Index>& fast,
                         const std::vector<Index>& bolted, const std::vector<MovingBlock>& before, const Blocks& blocks,
                         const Contacts& contacts, const BlockContacts& list, std::vector<MovingBlock>& moving)
{
    const View view{model, rule, blocks, contacts, list};
    for (const Index block : marked_)
        mark_[block] = Mark::unknown;
    marked_.clear();
    mark_.resize(static_cast<std::size_t>(blocks.size()), Mark::unknown);
    for (const Index block : bolted)
        set(block, Mark::held);
    for (const Index block : fast)
        for_contacts(block, list,
                     [&](Index contact)
                     {
                         const Index other = other_block(block, contact, contacts);
                         if (do_touch(contact, contacts) && is_slow(other, view))
                             search_from(other, view);
                     });
    const GroupRule goes_on{.speed = share_of_stopped * rule.speed};
    for (const MovingBlock& block : before)
        if (!fast.empty() && block.how == FreeMotion::dragged && is_slow(block.block, view) &&
            is_fast(block.block, model, goes_on, blocks))
            for_contacts(block.block, list,
                         [&](Index contact)
                         {
                             if (is_somewhere(Tie::slides, contact, view))
                                 search_from(block.block, view);
                         });
    std::ranges::sort(marked_);
    const auto known = std::ssize(moving);
    const auto is_known = [&](Index block)
    { return std::ranges::binary_search(std::views::take(moving, known), block, {}, &MovingBlock::block); };
    for (const Index block : marked_)
        if (mark_[block] == Mark::dragged && !is_known(block))
            moving.push_back({block, FreeMotion::dragged, 1.0F, 0.0F});
    std::ranges::inplace_merge(moving, moving.begin() + known, {}, &MovingBlock::block);
}
}  // namespace hdem
