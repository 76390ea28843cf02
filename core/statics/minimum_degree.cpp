#include "core/statics/minimum_degree.h"

#include <algorithm>
#include <bit>

namespace hdem
{
namespace
{
/// More neighbours outside of the set than this times its size are left out of the count: rows of bits grow with the square.
constexpr std::size_t most_around = 8;
}  // namespace

MinimumDegree::MinimumDegree(const BlockGraph& graph) : graph_(&graph), local_(static_cast<std::size_t>(graph.blocks()), no_index)
{
}

Index MinimumDegree::count(Index i) const
{
    Index bits = 0;
    for (std::size_t w = 0; w < words_; ++w)
        bits += std::popcount(row(i)[w]);
    return bits;
}

void MinimumDegree::gather(std::span<const Index> blocks)
{
    inner_ = static_cast<Index>(blocks.size());
    block_.assign(blocks.begin(), blocks.end());
    for (Index i = 0; i < inner_; ++i)
        local_[block_[i]] = i;
    for (Index i = 0; i < inner_; ++i)
        for (const Index next : graph_->of(block_[i]))
            if (local_[next] == no_index && block_.size() < (1 + most_around) * blocks.size())
            {
                local_[next] = static_cast<Index>(block_.size());
                block_.push_back(next);
            }
    words_ = (block_.size() + 63) / 64;
    bits_.assign(block_.size() * words_, 0);
    const auto set = [&](Index i, Index j) { row(i)[j / 64] |= std::uint64_t{1} << (j % 64); };
    for (Index i = 0; i < inner_; ++i)
        for (const Index next : graph_->of(block_[i]))
            if (local_[next] != no_index)
            {
                set(i, local_[next]);
                set(local_[next], i);
            }
    degree_.resize(blocks.size());
    for (Index i = 0; i < inner_; ++i)
        degree_[i] = count(i);
}

/// Neighbours of the pivot become neighbours of each other.
void MinimumDegree::eliminate(Index pivot, std::vector<Index>& front)
{
    near_.clear();
    for (std::size_t w = 0; w < words_; ++w)
        for (std::uint64_t left = row(pivot)[w]; left != 0; left &= left - 1)
            near_.push_back(static_cast<Index>(64 * w) + std::countr_zero(left));
    for (const Index i : near_)
    {
        for (std::size_t w = 0; w < words_; ++w)
            row(i)[w] |= row(pivot)[w];
        clear(i, i);
        clear(i, pivot);
        if (i < inner_)
            degree_[i] = count(i);
    }
    degree_[pivot] = no_index;
    front.push_back(pivot);
    // Now they all touch each other: who has no other neighbours follows at once.
    const auto others = static_cast<Index>(near_.size()) - 1;
    std::erase_if(near_,
                  [&](Index i)
                  {
                      if (i >= inner_ || degree_[i] != others)
                          return false;
                      degree_[i] = no_index;
                      front.push_back(i);
                      return true;
                  });
    for (const Index i : near_)
        for (std::size_t k = 1; k < front.size(); ++k)
        {
            clear(i, front[k]);
            if (i < inner_)
                --degree_[i];
        }
}

void MinimumDegree::order(std::span<Index> blocks, std::vector<Index>& front_size)
{
    gather(blocks);
    std::vector<Index> front, all;
    while (static_cast<Index>(all.size()) < inner_)
    {
        Index pivot = no_index;
        for (Index i = 0; i < inner_; ++i)
            if (degree_[i] != no_index && (pivot == no_index || degree_[i] < degree_[pivot]))
                pivot = i;
        front.clear();
        eliminate(pivot, front);
        front_size.push_back(static_cast<Index>(front.size()));
        all.insert(all.end(), front.begin(), front.end());
    }
    std::transform(all.begin(), all.end(), blocks.begin(), [&](Index i) { return block_[i]; });
    for (const Index block : block_)
        local_[block] = no_index;
}
}  // namespace hdem
