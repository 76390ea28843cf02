#include "core/motion/dragged_blocks.h"

#include <algorithm>
#include <iterator>

namespace hdem
{
namespace
{
/// Of the speed of fast blocks: a dragged block that is slower has stopped. Undamped, its springs would swing on for ever.
constexpr double share_of_stopped = 0.05;

bool is_slow(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks)
{
    return blocks.present[block] != 0 && is_unbound(blocks.inertia[block]) && !is_fast(block, model, rule, blocks);
}

bool does_slide(Index block, const ContactTies& ties)
{
    return ties.any_contact(block, [&](Index contact, Index) { return ties.is_somewhere(Tie::slides, contact); });
}
}  // namespace

void DraggedBlocks::clear(Index blocks)
{
    for (const Index block : marked_)
        mark_[block] = Mark::unknown;
    marked_.clear();
    mark_.resize(static_cast<std::size_t>(blocks), Mark::unknown);
}

void DraggedBlocks::set(Index block, Mark mark)
{
    if (mark_[block] == Mark::unknown)
        marked_.push_back(block);
    mark_[block] = mark;
}

/// Adds the blocks that stick to this one to its group.
bool DraggedBlocks::is_held(Index block, const ContactTies& ties)
{
    return ties.any_contact(block,
                            [&](Index contact, Index other)
                            {
                                if (!ties.is_somewhere(Tie::sticks, contact))
                                    return false;
                                if (!is_unbound(ties.blocks.inertia[other]) || mark_[other] == Mark::held)
                                    return true;
                                if (mark_[other] == Mark::unknown)
                                {
                                    set(other, Mark::searched);
                                    group_.push_back(other);
                                }
                                return false;
                            });
}

void DraggedBlocks::search_from(Index seed, const ContactTies& ties)
{
    if (mark_[seed] != Mark::unknown)
        return;
    set(seed, Mark::searched);
    group_.assign(1, seed);
    bool held = false;
    for (std::size_t at = 0; at < group_.size() && !held; ++at)
        held = is_held(group_[at], ties) || group_.size() > most_blocks_of_body;
    // What only bounces is not pushed along.
    held = held || std::ranges::none_of(group_, [&](Index block) { return does_slide(block, ties); });
    for (const Index block : group_)
        set(block, held ? Mark::held : Mark::dragged);
}

void DraggedBlocks::find(const Model& model, const GroupRule& rule, const std::vector<Index>& fast,
                         const std::vector<Index>& bolted, const std::vector<MovingBlock>& before, const ContactTies& ties,
                         std::vector<MovingBlock>& moving)
{
    const Blocks& blocks = ties.blocks;
    clear(blocks.size());
    for (const Index block : bolted)
        set(block, Mark::held);
    for (const Index block : fast)
        ties.for_contacts(block,
                          [&](Index contact, Index other)
                          {
                              if (ties.do_touch(contact) && is_slow(other, model, rule, blocks))
                                  search_from(other, ties);
                          });
    const GroupRule goes_on{.speed = share_of_stopped * rule.speed};
    for (const auto& [block, how, t_x, t_y] : before)
        if (!fast.empty() && how == FreeMotion::dragged && is_slow(block, model, rule, blocks) &&
            is_fast(block, model, goes_on, blocks) && does_slide(block, ties))
            search_from(block, ties);
    std::ranges::sort(marked_);
    const auto known = std::ssize(moving);
    const auto is_known = [&](Index block)
    { return std::ranges::binary_search(moving.begin(), moving.begin() + known, block, {}, &MovingBlock::block); };
    for (const Index block : marked_)
        if (mark_[block] == Mark::dragged && !is_known(block))
            moving.push_back({block, FreeMotion::dragged, 1.0F, 0.0F});
    std::ranges::inplace_merge(moving, moving.begin() + known, {}, &MovingBlock::block);
}
}  // namespace hdem
