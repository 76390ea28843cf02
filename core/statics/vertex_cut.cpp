#include "core/statics/vertex_cut.h"

#include <algorithm>
#include <limits>

namespace hdem
{
namespace
{
// What stands before and after a block on its path, where that is no block.
constexpr Index nothing = -1;  ///< no path
constexpr Index source = -2;
constexpr Index sink = -3;

// Results of next_node().
constexpr Index no_more = -1;
constexpr Index closed = -4;

Index entry(Index block)
{
    return 2 * block;
}
Index exit(Index block)
{
    return 2 * block + 1;
}
bool is_exit(Index node)
{
    return node % 2 != 0;
}
}  // namespace

VertexCut::VertexCut(const BlockGraph& graph) : graph_(&graph), local_(static_cast<std::size_t>(graph.blocks()), no_index)
{
}

void VertexCut::gather_band(int layers, Index kept, const std::vector<CutSide>& side, const GraphCut& cut)
{
    std::array<Index, 2> room{cut.size[0] - kept, cut.size[1] - kept};
    band_ = cut.separator;
    for (std::size_t i = 0; i < band_.size(); ++i)
        local_[band_[i]] = static_cast<Index>(i);
    std::size_t begin = 0;
    for (int layer = 0; layer < layers && begin < band_.size(); ++layer)
    {
        const std::size_t end = band_.size();
        for (; begin < end; ++begin)
            for (const Index next : graph_->of(band_[begin]))
                if (side[next] <= CutSide::right && local_[next] == no_index && room[static_cast<int>(side[next])] > 0)
                {
                    --room[static_cast<int>(side[next])];
                    local_[next] = static_cast<Index>(band_.size());
                    band_.push_back(next);
                }
    }
}

void VertexCut::link_band(const std::vector<CutSide>& side, CutSide from)
{
    const std::size_t size = band_.size();
    arc_begin_.assign(1, 0);
    arc_.clear();
    starts_.assign(size, 0);
    ends_.assign(size, 0);
    for (std::size_t i = 0; i < size; ++i)
    {
        for (const Index next : graph_->of(band_[i]))
            if (local_[next] != no_index)
                arc_.push_back(local_[next]);
            else if (side[next] <= CutSide::right)
                (side[next] == from ? starts_ : ends_)[i] = 1;
        arc_begin_.push_back(static_cast<Index>(arc_.size()));
    }
    before_.assign(size, nothing);
    after_.assign(size, nothing);
}

/// The node that arc `arc` of a node leads to along which one more path can go, or an old one can be led back: sink, closed, or no_more.
Index VertexCut::next_node(Index node, Index arc) const
{
    const Index block = node / 2;
    if (!is_exit(node))
    {
        if (arc > 0 || before_[block] == source)
            return no_more;
        return before_[block] == nothing ? exit(block) : exit(before_[block]);
    }
    if (arc == 0)
        return ends_[block] != 0 && after_[block] != sink ? sink : closed;
    if (arc == 1)
        return before_[block] != nothing ? entry(block) : closed;
    const Index at = arc_begin_[block] + arc - 2;
    if (at == arc_begin_[block + 1])
        return no_more;
    return arc_[at] != after_[block] ? entry(arc_[at]) : closed;
}

/// Number nodes by their distance to the sink, until the source is reached. Is it?
bool VertexCut::find_layers()
{
    layer_.assign(2 * band_.size(), no_index);
    queue_.clear();
    const auto reach = [&](Index node, Index layer)
    {
        if (layer_[node] != no_index)
            return;
        layer_[node] = layer;
        queue_.push_back(node);
    };
    for (Index i = 0; i < static_cast<Index>(band_.size()); ++i)
        if (ends_[i] != 0 && after_[i] != sink)
            reach(exit(i), 0);
    Index last = std::numeric_limits<Index>::max();
    for (std::size_t head = 0; head < queue_.size(); ++head)
    {
        const Index node = queue_[head], block = node / 2, layer = layer_[node] + 1;
        if (layer > last)
            break;
        if (is_exit(node))
        {
            if (before_[block] == nothing)
                reach(entry(block), layer);
            else if (after_[block] >= 0)
                reach(entry(after_[block]), layer);
            continue;
        }
        if (starts_[block] != 0 && before_[block] != source)
            last = std::min(last, layer - 1);
        if (before_[block] != nothing)
            reach(exit(block), layer);
        for (Index at = arc_begin_[block]; at < arc_begin_[block + 1]; ++at)
            if (after_[arc_[at]] != block)
                reach(exit(arc_[at]), layer);
    }
    return last != std::numeric_limits<Index>::max();
}

/// One more path, from layer to layer; nodes that lead nowhere are not tried again.
bool VertexCut::find_path(Index start)
{
    path_.assign(1, start);
    while (!path_.empty())
    {
        const Index node = path_.back();
        const Index next = next_node(node, tried_[node]);
        if (next == sink)
            return true;
        if (next == no_more)
        {
            layer_[node] = no_index;
            path_.pop_back();
            if (!path_.empty())
                ++tried_[path_.back()];
        }
        else if (next != closed && layer_[next] != no_index && layer_[next] == layer_[node] - 1)
            path_.push_back(next);
        else
            ++tried_[node];
    }
    return false;
}

void VertexCut::add_path()
{
    for (std::size_t k = 0; k < path_.size(); ++k)
    {
        const Index block = path_[k] / 2;
        layer_[path_[k]] = no_index;
        if (is_exit(path_[k]) && k + 1 < path_.size() && path_[k + 1] == entry(block))  // the old path leaves this block
            before_[block] = after_[block] = nothing;
    }
    before_[path_.front() / 2] = source;
    for (std::size_t k = 0; k + 1 < path_.size(); ++k)
        if (const Index from = path_[k] / 2, to = path_[k + 1] / 2; is_exit(path_[k]) && from != to)
        {
            after_[from] = to;
            before_[to] = from;
        }
    after_[path_.back() / 2] = sink;
}

void VertexCut::shrink(int layers, Index kept, std::vector<CutSide>& side, GraphCut& cut)
{
    if (cut.separator.empty() || cut.size[0] == 0 || cut.size[1] == 0)
        return;
    gather_band(layers, kept, side, cut);
    // Of all smallest separators the one nearest to the sink is found: it takes blocks from that side.
    const CutSide to = cut.size[0] >= cut.size[1] ? CutSide::left : CutSide::right;
    const CutSide from = to == CutSide::left ? CutSide::right : CutSide::left;
    link_band(side, from);
    const auto size = static_cast<Index>(band_.size());
    while (find_layers())
    {
        tried_.assign(2 * band_.size(), 0);
        for (Index i = 0; i < size; ++i)
            if (starts_[i] != 0 && before_[i] != source && layer_[entry(i)] != no_index && find_path(entry(i)))
                add_path();
    }
    cut.separator.clear();
    for (Index i = 0; i < size; ++i)
    {
        const Index block = band_[i];
        local_[block] = no_index;
        if (side[block] != CutSide::separator)
            --cut.size[static_cast<int>(side[block])];
        const bool leads_on = layer_[exit(i)] != no_index || after_[i] == sink;
        side[block] = layer_[entry(i)] != no_index ? to : leads_on ? CutSide::separator : from;
        if (side[block] == CutSide::separator)
            cut.separator.push_back(block);
        else
            ++cut.size[static_cast<int>(side[block])];
    }
}
}  // namespace hdem
