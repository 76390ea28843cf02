#include "parallel/contact_rebuild.h"

#include "core/detection/contact_tracking.h"
#include "core/state/contact_order.h"
#include "parallel/partition.h"
#include "parallel/team.h"

#include <algorithm>
#include <utility>

namespace hdem
{
namespace
{
/// Small models are cut into sixteen chunks, so that threads have equal shares of them.
Index parts_a_chunk(Index parts)
{
    constexpr Index least = 32, most = 512, chunks = 16;
    return std::clamp((parts + chunks - 1) / chunks, least, most);
}

/// Number of chunks whose contacts wait at the same time to be put into the list: a contact takes more memory by itself than in the list.
constexpr Index chunks_a_round = 64;

static_assert(contacts_a_stretch == largest_part, "packs do not reach from one part into the next");

bool holds(IndexRange range, Index i)
{
    return range.begin <= i && i < range.end;
}
}  // namespace

void ContactRebuild::run(const Model& model, State& state, const Team& team)
{
    team.alone(
        [&]
        {
            begin(model);
            list_.has_preload = state.contacts.has_preload;
            list_.has_memory = state.contacts.has_memory;
            old_order_ = order_by_parts(state.contacts);
            set_margins(model, state.blocks);
        });
    const auto count = static_cast<Index>(chunks_.size());
    const auto for_chunks = [&](IndexRange chunks, const auto& stage)
    {
        const IndexRange mine = team.share(chunks.size());
        for (Index i = chunks.begin + mine.begin; i < chunks.begin + mine.end; ++i)
            stage(chunks_[i]);
        team.barrier();
    };
    for_chunks({0, count}, [&](const Chunk& chunk) { compute_boxes(chunk.parts, model, state.blocks, boxes_); });
    team.alone([&] { cells_.build(boxes_); });
    for_chunks({0, count}, [&](Chunk& chunk) { find_pairs(chunk, model.shapes); });
    for_chunks({0, count}, [&](Chunk& chunk) { sort_pairs(chunk); });
    for (Index i = 0; i < count; i += chunks_a_round)
    {
        const IndexRange round{i, std::min(count, i + chunks_a_round)};
        for_chunks(round,
                   [&](Chunk& chunk)
                   {
                       track_contacts({0, static_cast<Index>(chunk.pairs.size())}, chunk.pairs, model, state.blocks, state.contacts,
                                      old_order_, chunk.contacts, chunk.ledger);
                   });
        team.alone([&] { place(round); });
        for_chunks(round,
                   [&](Chunk& chunk)
                   {
                       put_bearing_first(chunk.contacts, chunk.first, list_);
                       chunk.contacts = std::vector<Contact>();  // = {} would keep its memory
                       chunk.pairs = std::vector<std::uint64_t>();
                   });
    }
    team.alone([&] { finish(model, state); });
}

void ContactRebuild::begin(const Model& model)
{
    const Index parts = model.shapes.parts();
    boxes_.resize(static_cast<std::size_t>(parts));
    const Index each = parts_a_chunk(parts);
    chunks_.resize(static_cast<std::size_t>((parts + each - 1) / each));
    for (Index i = 0; i < static_cast<Index>(chunks_.size()); ++i)
        chunks_[i].parts = {i * each, std::min(parts, (i + 1) * each)};
}

void ContactRebuild::find_pairs(Chunk& chunk, const Shapes& shapes) const
{
    cells_.find_pairs(chunk.parts, chunk.pairs);
    std::erase_if(chunk.pairs,
                  [&](std::uint64_t pair) { return shapes.part_block[first_of(pair)] == shapes.part_block[second_of(pair)]; });
    const auto own = std::partition(chunk.pairs.begin(), chunk.pairs.end(),
                                    [&](std::uint64_t pair) { return holds(chunk.parts, first_of(pair)); });
    chunk.foreign.assign(own, chunk.pairs.end());
    std::sort(chunk.foreign.begin(), chunk.foreign.end());
    chunk.pairs.erase(own, chunk.pairs.end());
}

void ContactRebuild::sort_pairs(Chunk& chunk) const
{
    for (const Chunk& other : chunks_)
    {
        const auto first = std::lower_bound(other.foreign.begin(), other.foreign.end(), chunk.parts.begin,
                                            [](std::uint64_t pair, Index part) { return first_of(pair) < part; });
        for (auto pair = first; pair != other.foreign.end() && first_of(*pair) < chunk.parts.end; ++pair)
            chunk.pairs.push_back(*pair);
    }
    std::sort(chunk.pairs.begin(), chunk.pairs.end());
}

void ContactRebuild::place(IndexRange round)
{
    if (round.begin == 0)
    {
        std::size_t pairs = 0;
        for (const Chunk& chunk : chunks_)
            pairs += chunk.pairs.size();
        list_.reserve(static_cast<Index>(pairs));
    }
    Index size = list_.size();
    for (Index i = round.begin; i < round.end; ++i)
    {
        chunks_[i].first = size;
        size += static_cast<Index>(chunks_[i].contacts.size());
    }
    list_.resize(size);
}

void ContactRebuild::finish(const Model& model, State& state)
{
    if (list_.has_memory)
        group_alike(model.joints, list_);
    for (const Chunk& chunk : chunks_)
        state.ledger.add(chunk.ledger);
    state.contacts = std::move(list_);
    state.rebuilt_at = state.blocks.motion;
    state.contacts_outdated = false;
    ++state.broad_phase_runs;
    *this = {};  // rare enough to give the memory back
}
}  // namespace hdem
