#include "core/motion/creeping_blocks.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr std::int64_t looked_every = 256;  // cycles
constexpr std::int32_t looks_before = 4;
constexpr std::int32_t looks_undamped = 16;
constexpr double least_cosine = 0.5;

/// The block after another look.
/// @param before  it is known
CreepingBlock look_at(Index block, double radius, const BlockMotion& now, const CreepingBlock* before)
{
    CreepingBlock seen{.block = block, .x = now.x, .y = now.y, .turn = radius * now.angle};
    if (before == nullptr)
        return seen;
    seen.by_x = seen.x - before->x;
    seen.by_y = seen.y - before->y;
    seen.by_turn = seen.turn - before->turn;
    const double along = seen.by_x * before->by_x + seen.by_y * before->by_y + seen.by_turn * before->by_turn;
    const double now_squared = seen.by_x * seen.by_x + seen.by_y * seen.by_y + seen.by_turn * seen.by_turn;
    const double before_squared = before->by_x * before->by_x + before->by_y * before->by_y + before->by_turn * before->by_turn;
    const bool goes_on = along > 0.0 && along * along > least_cosine * least_cosine * now_squared * before_squared;
    const bool is_over = before->looks + 1 == looks_before + looks_undamped;
    seen.looks = goes_on && !is_over ? before->looks + 1 : 0;
    return seen;
}
}  // namespace

bool looks_for_creep(std::int64_t cycles_of_stage)
{
    return cycles_of_stage % looked_every == 0;
}

bool creeps(const CreepingBlock& block)
{
    return block.looks >= looks_before;
}

void watch_creep(const Model& model, const GroupRule& rule, const Blocks& blocks, const std::vector<Index>& bolted,
                 std::vector<CreepingBlock>& slow)
{
    std::vector<CreepingBlock> seen;
    auto known = slow.cbegin();
    for (Index block = 0; block < blocks.size(); ++block)
    {
        if (!blocks.is_loose(block, rule.loose_distance) || !blocks.takes_part(block) || is_fast(block, model, rule, blocks) ||
            !is_unbound(blocks.inertia[block]) || std::ranges::binary_search(bolted, block))
            continue;
        known = std::lower_bound(known, slow.cend(), block, [](const CreepingBlock& b, Index number) { return b.block < number; });
        const bool is_known = known != slow.cend() && known->block == block;
        seen.push_back(look_at(block, model.radius[block], blocks.motion[block], is_known ? &*known : nullptr));
    }
    slow.swap(seen);
}

void mark_creeping(IndexRange range, const std::vector<CreepingBlock>& slow, Blocks& blocks)
{
    for (auto at = std::ranges::lower_bound(slow, range.begin, {}, &CreepingBlock::block);
         at != slow.end() && at->block < range.end; ++at)
    {
        BlockForce& force = blocks.force[at->block];
        if (!creeps(*at) || force.contacts == 0)
            continue;
        force.reserve = 0.0;
        force.mobilised = -1.0F;  // as if no joint bore it: nothing damps it
    }
}
}  // namespace hdem
