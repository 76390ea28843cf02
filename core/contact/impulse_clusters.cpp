#include "core/contact/impulse_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace hdem
{
namespace
{
double mass_of(const BlockInertia& inertia)
{
    return 1.0 / std::max(inertia.inverse_mass_x,
                          inertia.inverse_mass_y);  // infinite for a block that can only turn: it counts as neither
}

/// Flood of one heavy block after the other, the heaviest first.
class Floods
{
  public:
    Floods(const Island& island, const Blocks& blocks, double ratio) : ratio_(ratio), first_(island.blocks.size() + 1, 0)
    {
        for (const Index block : island.blocks)
            mass_.push_back(mass_of(blocks.inertia[block]));
        cluster_.assign(mass_.size(), no_index);
        std::vector<Index> heavy = heavy_blocks(island);
        if (heavy.empty())
            return;
        list_neighbours(island);
        find_idle();
        std::sort(heavy.begin(), heavy.end(), [&](Index a, Index b) { return mass_[a] != mass_[b] ? mass_[a] > mass_[b] : a < b; });
        for (const Index block : heavy)
            flood(block);
    }

    [[nodiscard]] bool none() const { return parent_.empty(); }

    /// Cluster of a point with these ends, or no_index.
    [[nodiscard]] Index cluster(const std::array<Index, 2>& ends)
    {
        for (const Index block : ends)
            if (block != no_index && cluster_[block] != no_index)
                return root(cluster_[block]);
        return no_index;
    }

  private:
    /// Blocks with a neighbour that is light to them.
    [[nodiscard]] std::vector<Index> heavy_blocks(const Island& island) const
    {
        std::vector<char> is_heavy(mass_.size(), 0);
        for (const auto& [ref, inc] : island.ends)
            if (ref != no_index && inc != no_index)
            {
                if (is_light(inc, ref))
                    is_heavy[ref] = 1;
                if (is_light(ref, inc))
                    is_heavy[inc] = 1;
            }
        std::vector<Index> heavy;
        for (std::size_t i = 0; i < is_heavy.size(); ++i)
            if (is_heavy[i] != 0)
                heavy.push_back(static_cast<Index>(i));
        return heavy;
    }
    [[nodiscard]] bool is_light(Index block, Index to) const { return mass_[block] * ratio_ < mass_[to] && !std::isinf(mass_[to]); }

    void list_neighbours(const Island& island)
    {
        for (const auto& ends : island.ends)
            for (const Index block : ends)
                if (block != no_index)
                    ++first_[static_cast<std::size_t>(block) + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        neighbour_.resize(first_.back());
        std::vector<std::size_t> end = first_;
        for (const auto& [ref, inc] : island.ends)
        {
            if (ref != no_index)
                neighbour_[end[ref]++] = inc;
            if (inc != no_index)
                neighbour_[end[inc]++] = ref;
        }
    }
    /// Once for each point; no_index: one that cannot move.
    [[nodiscard]] std::span<const Index> neighbours(Index block) const
    {
        return std::span<const Index>(neighbour_)
            .subspan(first_[block], first_[static_cast<std::size_t>(block) + 1] - first_[block]);
    }

    /// Blocks with one neighbour that is no lighter, without those found before.
    void find_idle()
    {
        idle_.assign(mass_.size(), 0);
        std::vector<Index> open(mass_.size());
        std::iota(open.begin(), open.end(), 0);
        while (!open.empty())
        {
            const Index block = open.back();
            open.pop_back();
            if (idle_[block] != 0 || !carries_nothing(block))
                continue;
            idle_[block] = 1;
            for (const Index to : neighbours(block))
                if (to != no_index && idle_[to] == 0)
                    open.push_back(to);
        }
    }
    [[nodiscard]] bool carries_nothing(Index block) const
    {
        bool has_one = false;
        Index one = no_index;
        for (const Index to : neighbours(block))
        {
            if (to != no_index && idle_[to] != 0)
                continue;
            if (has_one && to != one)
                return false;
            has_one = true;
            one = to;
        }
        return one == no_index || mass_[one] >= mass_[block];
    }

    /// What an earlier flood has reached has been followed to the end: its limit was higher.
    void flood(Index heavy)
    {
        Index own = no_index;
        std::vector<Index> open{heavy};
        while (!open.empty())
        {
            const Index from = open.back();
            open.pop_back();
            for (const Index to : neighbours(from))
            {
                if (to == no_index || !is_light(to, heavy) || idle_[to] != 0)
                    continue;
                const bool is_new = cluster_[to] == no_index;
                if (own == no_index)
                    own = is_new ? make_cluster() : root(cluster_[to]);
                if (is_new)
                {
                    cluster_[to] = own;
                    open.push_back(to);
                }
                else
                    parent_[root(cluster_[to])] = root(own);
            }
        }
    }
    Index make_cluster()
    {
        parent_.push_back(static_cast<Index>(parent_.size()));
        return parent_.back();
    }
    Index root(Index cluster)
    {
        while (parent_[cluster] != cluster)
            cluster = parent_[cluster] = parent_[parent_[cluster]];
        return cluster;
    }

    double ratio_;
    std::vector<double> mass_;
    std::vector<std::size_t> first_;  ///< neighbour of each block, and their number
    std::vector<Index> neighbour_;
    std::vector<char> idle_;
    std::vector<Index> cluster_, parent_;
};
}  // namespace

std::vector<Index> clusters_of(const Island& island, const Blocks& blocks, double ratio)
{
    Floods floods(island, blocks, ratio);
    if (floods.none())
        return {};
    std::vector<Index> number(island.blocks.size(), no_index), cluster;  // there are no more clusters than blocks
    Index count = 0;
    for (const auto& ends : island.ends)
    {
        const Index found = floods.cluster(ends);
        if (found != no_index && number[found] == no_index)
            number[found] = count++;
        cluster.push_back(found == no_index ? no_index : number[found]);
    }
    return cluster;
}
}  // namespace hdem
