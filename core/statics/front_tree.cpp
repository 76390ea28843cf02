#include "core/statics/front_tree.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Zeros that joined fronts may store, as a share of their factor.
constexpr double most_zeros = 0.25;

/// Time of a front [ns]: a start, operations, and what it hands on to be added to its parent. Only the ratios of these times matter.
double front_time(double own, double border)
{
    const double k = 3.0 * own, b = 3.0 * border;
    return 250.0 + (k * k * k / 3.0 + k * k * b + k * b * b) / 12.0 + 0.6 * b * b;
}

/// Numbers of a factor in units of 9.
double factor_blocks(double own, double border)
{
    return own * (own + 1.0) / 2.0 + own * border;
}

/// Fronts as they come from the dissection, then joined.
class TreeBuilder
{
  public:
    TreeBuilder(const BlockGraph& graph, const EliminationOrder& order) : graph_(&graph), raw_(&order) {}

    FrontTree build()
    {
        find_borders();
        join_fronts();
        number_fronts();
        sort_borders();
        link_to_parents();
        return std::move(tree_);
    }

  private:
    [[nodiscard]] Index raw_fronts() const { return static_cast<Index>(raw_->front_begin.size()) - 1; }
    void find_borders();
    void add_child(Index front, Index child);
    void join_fronts();
    void join_children(Index front);
    void number_fronts();
    void sort_borders();
    void link_to_parents();

    const BlockGraph* graph_;
    const EliminationOrder* raw_;
    FrontTree tree_;
    std::vector<Index> raw_place_;

    // One per raw front.
    std::vector<Index> border_begin_;  ///< and one more
    std::vector<Index> border_;        ///< raw places, in no order
    std::vector<Index> parent_, first_child_, last_child_, next_sibling_;
    std::vector<Index> own_;                         ///< blocks, those of joined fronts counted; 0: joined with its parent
    std::vector<double> zeros_;                      ///< stored in vain, in units of 9 numbers
    std::vector<Index> first_joined_, next_joined_;  ///< the fronts that one consists of besides its own
    std::vector<Index> number_;                      ///< of the front in the tree, or no_index
    std::vector<Index> raw_of_;                      ///< its inverse
};

void TreeBuilder::add_child(Index front, Index child)
{
    if (first_child_[front] == no_index)
        first_child_[front] = child;
    else
        next_sibling_[last_child_[front]] = child;
    last_child_[front] = child;
}

/// What a front touches: later neighbours of its own blocks, and what its children touch.
void TreeBuilder::find_borders()
{
    const auto fronts = static_cast<std::size_t>(raw_fronts());
    const std::vector<Index>& order = raw_->order;
    raw_place_.resize(order.size());
    std::vector<Index> front_at(order.size()), seen(order.size(), no_index);
    for (Index front = 0; front < raw_fronts(); ++front)
        for (Index place = raw_->front_begin[front]; place < raw_->front_begin[front + 1]; ++place)
        {
            raw_place_[order[place]] = place;
            front_at[place] = front;
        }
    for (std::vector<Index>* links : {&parent_, &first_child_, &last_child_, &next_sibling_})
        links->assign(fronts, no_index);
    border_begin_.assign(1, 0);
    for (Index front = 0; front < raw_fronts(); ++front)
    {
        const Index end = raw_->front_begin[front + 1];
        Index first = static_cast<Index>(order.size());
        const auto touch = [&](Index place)
        {
            if (place < end || seen[place] == front)
                return;
            seen[place] = front;
            border_.push_back(place);
            first = std::min(first, place);
        };
        for (Index place = raw_->front_begin[front]; place < end; ++place)
            for (const Index next : graph_->of(order[place]))
                touch(raw_place_[next]);
        for (Index child = first_child_[front]; child != no_index; child = next_sibling_[child])
            for (Index i = border_begin_[child]; i < border_begin_[child + 1]; ++i)
                touch(border_[i]);
        border_begin_.push_back(static_cast<Index>(border_.size()));
        if (first < static_cast<Index>(order.size()))
        {
            parent_[front] = front_at[first];
            add_child(parent_[front], front);
        }
    }
}

/// Join children with a front while that saves time. The children of a joined child are the front's then and are looked at too.
void TreeBuilder::join_children(Index front)
{
    const Index border = border_begin_[front + 1] - border_begin_[front];
    Index before = no_index;
    for (Index child = first_child_[front]; child != no_index; child = next_sibling_[child])
    {
        const Index child_border = border_begin_[child + 1] - border_begin_[child];
        const Index own = own_[front] + own_[child];
        const double zeros = zeros_[front] + zeros_[child] +
                             static_cast<double>(own_[child]) * (own_[front] + border - child_border);
        const bool saves = front_time(own_[child], child_border) + front_time(own_[front], border) > front_time(own, border);
        if (!saves || zeros > most_zeros * factor_blocks(own, border))
        {
            before = child;
            continue;
        }
        own_[front] = own;
        own_[child] = 0;
        zeros_[front] = zeros;
        next_joined_[child] = first_joined_[front];
        first_joined_[front] = child;
        // Its children take its place at the end of the list.
        if (first_child_[child] != no_index)
        {
            next_sibling_[last_child_[front]] = first_child_[child];
            last_child_[front] = last_child_[child];
        }
        (before == no_index ? first_child_[front] : next_sibling_[before]) = next_sibling_[child];
        if (last_child_[front] == child)
            last_child_[front] = before;
    }
}

void TreeBuilder::join_fronts()
{
    const auto fronts = static_cast<std::size_t>(raw_fronts());
    own_.resize(fronts);
    zeros_.assign(fronts, 0.0);
    first_joined_.assign(fronts, no_index);
    next_joined_.assign(fronts, no_index);
    for (Index front = 0; front < raw_fronts(); ++front)
    {
        own_[front] = raw_->front_begin[front + 1] - raw_->front_begin[front];
        join_children(front);
    }
}

/// Children before their parents, subtree after subtree; own blocks in the order of the dissection.
void TreeBuilder::number_fronts()
{
    const auto fronts = static_cast<std::size_t>(raw_fronts());
    number_.assign(fronts, no_index);
    std::vector<Index> stack, next_child = first_child_, joined, own;
    tree_.place.resize(raw_->order.size());
    const auto close = [&](Index front)
    {
        number_[front] = tree_.fronts();
        raw_of_.push_back(front);
        tree_.parent.push_back(no_index);
        own.clear();
        joined.assign(1, front);
        while (!joined.empty())
        {
            const Index part = joined.back();
            joined.pop_back();
            for (Index place = raw_->front_begin[part]; place < raw_->front_begin[part + 1]; ++place)
                own.push_back(place);
            for (Index more = first_joined_[part]; more != no_index; more = next_joined_[more])
                joined.push_back(more);
        }
        std::sort(own.begin(), own.end());
        for (const Index place : own)
        {
            tree_.place[raw_->order[place]] = static_cast<Index>(tree_.order.size());
            tree_.order.push_back(raw_->order[place]);
        }
        tree_.own_begin.push_back(static_cast<Index>(tree_.order.size()));
    };
    for (Index root = 0; root < raw_fronts(); ++root)
    {
        if (parent_[root] != no_index)
            continue;
        stack.assign(1, root);
        while (!stack.empty())
        {
            const Index front = stack.back();
            const Index child = next_child[front];
            if (child != no_index)
            {
                next_child[front] = next_sibling_[child];
                stack.push_back(child);
                continue;
            }
            close(front);
            stack.pop_back();
            if (!stack.empty())
                tree_.parent.back() = stack.back();  // its raw number for now
        }
    }
    for (Index& parent : tree_.parent)
        if (parent != no_index)
            parent = number_[parent];
}

/// The border of a front is that of the last of those it was joined from.
void TreeBuilder::sort_borders()
{
    for (Index front = 0; front < tree_.fronts(); ++front)
    {
        const Index raw = raw_of_[front];
        const auto begin = static_cast<std::ptrdiff_t>(tree_.border.size());
        for (Index i = border_begin_[raw]; i < border_begin_[raw + 1]; ++i)
            tree_.border.push_back(tree_.place[raw_->order[border_[i]]]);
        std::sort(tree_.border.begin() + begin, tree_.border.end());
        tree_.border_begin.push_back(static_cast<Index>(tree_.border.size()));
    }
}

void TreeBuilder::link_to_parents()
{
    tree_.row_in_parent.resize(tree_.border.size());
    tree_.child_begin.assign(static_cast<std::size_t>(tree_.fronts()) + 1, 0);
    for (Index front = 0; front < tree_.fronts(); ++front)
    {
        const Index parent = tree_.parent[front];
        if (parent == no_index)
            continue;
        ++tree_.child_begin[parent + 1];
        const Index own_end = tree_.own_begin[parent + 1];
        Index at = tree_.border_begin[parent];
        for (Index i = tree_.border_begin[front]; i < tree_.border_begin[front + 1]; ++i)
        {
            const Index place = tree_.border[i];
            if (place < own_end)
            {
                tree_.row_in_parent[i] = place - tree_.own_begin[parent];
                continue;
            }
            while (tree_.border[at] < place)
                ++at;
            tree_.row_in_parent[i] = tree_.own(parent) + at - tree_.border_begin[parent];
        }
    }
    for (std::size_t i = 1; i < tree_.child_begin.size(); ++i)
        tree_.child_begin[i] += tree_.child_begin[i - 1];
    tree_.child.resize(static_cast<std::size_t>(tree_.child_begin.back()));
    std::vector<Index> end(tree_.child_begin.begin(), tree_.child_begin.end() - 1);
    for (Index front = 0; front < tree_.fronts(); ++front)
        if (tree_.parent[front] != no_index)
            tree_.child[end[tree_.parent[front]]++] = front;
}
}  // namespace

double operations(const FrontShape& shape)
{
    const double k = shape.own, b = shape.border;
    return k * k * k / 3.0 + k * k * b + k * b * b;
}

FrontTree make_front_tree(const BlockGraph& graph, const EliminationOrder& order)
{
    return TreeBuilder(graph, order).build();
}
}  // namespace hdem
