#include "core/statics/dissection.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hdem
{
namespace
{
/// Larger sets are cut.
constexpr Index leaf_size = 120;

// More lines, or a wider band, make hardly any factor smaller.
constexpr std::size_t lines_tried = 3;
constexpr int layers_tried = 1;  ///< of the band in which the lines are compared
constexpr int layers_best = 16;  ///< of the band around the best of them
constexpr double kept_share = 0.35;
}  // namespace

Dissector::Dissector(const BlockGraph& graph, const std::vector<Vec2>& places)
    : graph_(&graph),
      places_(&places),
      straight_cut_search_(graph, places),
      vertex_cut_(graph),
      minimum_degree_(graph),
      side_(static_cast<std::size_t>(graph.blocks()), CutSide::outside),
      best_side_(static_cast<std::size_t>(graph.blocks()))
{
}

/// The smaller border of the two sides separates them.
void Dissector::separate(std::span<const Index> blocks, GraphCut& cut)
{
    cut = {};
    std::array<std::vector<Index>, 2> border;
    for (const Index block : blocks)
    {
        const CutSide own = side_[block];
        ++cut.size[static_cast<int>(own)];
        const auto near = graph_->of(block);
        if (std::any_of(near.begin(), near.end(),
                        [&](Index next) { return side_[next] != own && side_[next] != CutSide::outside; }))
            border[static_cast<int>(own)].push_back(block);
    }
    const int thin = border[0].size() <= border[1].size() ? 0 : 1;
    cut.separator = border[thin];
    cut.size[thin] -= static_cast<Index>(cut.separator.size());
    for (const Index block : cut.separator)
        side_[block] = CutSide::separator;
}

void Dissector::cut_along(const StraightCut& line, std::span<const Index> blocks, GraphCut& cut)
{
    for (const Index block : blocks)
    {
        const Vec2& place = (*places_)[block];
        side_[block] = line.direction.x() * place.x() + line.direction.y() * place.y() < line.offset ? CutSide::left
                                                                                                     : CutSide::right;
    }
    separate(blocks, cut);
}

/// Where places tell nothing: by contacts to be crossed from one of the farthest blocks, piece after piece.
void Dissector::sort_by_steps(std::span<Index> blocks)
{
    std::vector<Index> found;
    const auto search = [&](Index from, CutSide before, CutSide after)
    {
        std::size_t head = found.size();
        side_[from] = after;
        for (found.push_back(from); head < found.size(); ++head)
            for (const Index next : graph_->of(found[head]))
                if (side_[next] == before)
                {
                    side_[next] = after;
                    found.push_back(next);
                }
    };
    for (const Index block : blocks)
        side_[block] = CutSide::left;
    for (const Index block : blocks)
        if (side_[block] == CutSide::left)
        {
            const std::size_t begin = found.size();
            search(block, CutSide::left, CutSide::right);
            const Index farthest = found.back();
            found.resize(begin);
            search(farthest, CutSide::right, CutSide::separator);
        }
    std::copy(found.begin(), found.end(), blocks.begin());
}

void Dissector::cut_by_steps(std::span<Index> blocks, GraphCut& cut)
{
    sort_by_steps(blocks);
    for (std::size_t i = 0; i < blocks.size(); ++i)
        side_[blocks[i]] = i < blocks.size() / 2 ? CutSide::left : CutSide::right;
    separate(blocks, cut);
}

std::array<Index, 3> Dissector::cut(std::span<Index> blocks)
{
    for (const Index block : blocks)
        side_[block] = CutSide::left;
    const std::vector<StraightCut> lines = straight_cut_search_.find(blocks, side_);
    const auto kept = [&](const GraphCut& cut) { return static_cast<Index>(kept_share * cut.blocks()); };
    GraphCut best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < std::min(lines.size(), lines_tried); ++i)
    {
        GraphCut cut;
        cut_along(lines[i], blocks, cut);
        vertex_cut_.shrink(layers_tried, kept(cut), side_, cut);
        const double cost = cost_of(static_cast<Index>(cut.separator.size()), cut.size[0], cut.size[1]);
        if (cost >= least)
            continue;
        least = cost;
        best = cut;
        for (const Index block : blocks)
            best_side_[block] = side_[block];
    }
    if (lines.empty())
        cut_by_steps(blocks, best);
    else
        for (const Index block : blocks)
            side_[block] = best_side_[block];
    vertex_cut_.shrink(layers_best, kept(best), side_, best);

    const auto is_on = [&](CutSide side) { return [&, side](Index block) { return side_[block] == side; }; };
    const auto right = std::stable_partition(blocks.begin(), blocks.end(), is_on(CutSide::left));
    const auto separator = std::stable_partition(right, blocks.end(), is_on(CutSide::right));
    for (const Index block : blocks)
        side_[block] = CutSide::outside;
    return {static_cast<Index>(right - blocks.begin()), static_cast<Index>(separator - right),
            static_cast<Index>(blocks.end() - separator)};
}

Dissection::Dissection(Index blocks) : order_(static_cast<std::size_t>(blocks))
{
    std::iota(order_.begin(), order_.end(), 0);
    if (blocks > 0)
        open_.push_back({{0, blocks}});
}

void Dissection::refine(Index i, Dissector& dissector)
{
    Set& set = open_[i];
    const auto blocks = std::span(order_).subspan(set.range.begin, set.range.size());
    if (set.range.size() > leaf_size)
        set.part = dissector.cut(blocks);
    else
        dissector.order_leaf(blocks, set.front_size);
}

void Dissection::descend()
{
    std::vector<Set> next;
    for (const Set& set : open_)
    {
        Index begin = set.range.begin;
        for (const Index size : set.front_size)
        {
            front_begin_.push_back(begin);
            begin += size;
        }
        if (set.range.size() <= leaf_size)
            continue;
        for (const Index size : {set.part[0], set.part[1]})
        {
            if (size > 0)
                next.push_back({{begin, begin + size}});
            begin += size;
        }
        if (begin < set.range.end)
            front_begin_.push_back(begin);
    }
    open_ = std::move(next);
}

EliminationOrder Dissection::result() &&
{
    front_begin_.push_back(static_cast<Index>(order_.size()));
    std::sort(front_begin_.begin(), front_begin_.end());
    return {std::move(order_), std::move(front_begin_)};
}

EliminationOrder dissect(const BlockGraph& graph, const std::vector<Vec2>& places)
{
    Dissector dissector(graph, places);
    Dissection dissection(graph.blocks());
    while (dissection.open() > 0)
    {
        for (Index i = 0; i < dissection.open(); ++i)
            dissection.refine(i, dissector);
        dissection.descend();
    }
    return std::move(dissection).result();
}
}  // namespace hdem
