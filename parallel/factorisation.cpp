#include "parallel/factorisation.h"

#include "core/check.h"

#include <algorithm>
#include <numeric>

namespace hdem
{
namespace
{
/// Rows of a front that one thread takes at a time.
constexpr Index panels_a_piece = 12;
constexpr Index blocks_a_piece = 32;

/// What a front costs besides its operations, in operations.
constexpr double front_start = 3000.0;
/// Fewer operations than this, half a millisecond, are not worth sharing.
constexpr double least_subtree = 1e7;

Index pieces(Index size, Index a_piece)
{
    return (size + a_piece - 1) / a_piece;
}

IndexRange piece(IndexRange range, Index i, Index a_piece)
{
    return {range.begin + i * a_piece, std::min(range.end, range.begin + (i + 1) * a_piece)};
}
}  // namespace

void Factorisation::analyse(const Team& team, const BlockGraph& graph, const std::vector<Vec2>& places)
{
    HDEM_EXPECT(static_cast<Index>(places.size()) == graph.blocks());
    team.alone([&] { dissection_.emplace(graph.blocks()); });
    Dissector dissector(graph, places);
    while (dissection_->open() > 0)
    {
        team.deal(dissection_->open(), [&](Index i) { dissection_->refine(i, dissector); });
        team.alone([&] { dissection_->descend(); });
    }
    team.alone(
        [&]
        {
            fronts_.set_pattern(graph, make_front_tree(graph, std::move(*dissection_).result()));
            dissection_.reset();
            choose_subtrees(team.threads());
            plan_memory(team.threads());
        });
}

/// Split the costliest subtrees until each is a small part of a thread's work.
void Factorisation::choose_subtrees(int threads)
{
    const FrontTree& tree = fronts_.tree();
    const auto size = static_cast<std::size_t>(tree.fronts());
    std::vector<double> cost(size);
    std::vector<Index> first(size);
    for (Index front = 0; front < tree.fronts(); ++front)
    {
        cost[front] = front_start + operations(tree.shape(front));
        first[front] = front;
        for (const Index child : tree.children(front))
        {
            cost[front] += cost[child];
            first[front] = std::min(first[front], first[child]);
        }
    }
    double all = 0.0;
    for (Index front = 0; front < tree.fronts(); ++front)
        if (tree.parent[front] == no_index)
            all += cost[front];
    const double most = threads > 1 ? std::max(all / (4.0 * threads), least_subtree) : all;

    std::vector<Index> roots;
    std::vector<std::uint8_t> is_split(size, 0);
    is_shared_.assign(size, 0);
    top_.clear();
    for (Index front = tree.fronts() - 1; front >= 0; --front)
        if (const Index parent = tree.parent[front]; parent == no_index || is_split[parent] != 0)
        {
            is_shared_[front] = 1;
            is_split[front] = cost[front] > most ? 1 : 0;
            (is_split[front] != 0 ? top_ : roots).push_back(front);
        }
    std::reverse(top_.begin(), top_.end());
    std::stable_sort(roots.begin(), roots.end(), [&](Index a, Index b) { return cost[a] > cost[b]; });
    subtree_.clear();
    for (const Index root : roots)
        subtree_.push_back({first[root], root + 1});
}

void Factorisation::plan_memory(int threads)
{
    const FrontTree& tree = fronts_.tree();
    std::vector<std::size_t> border_sizes(static_cast<std::size_t>(tree.fronts()));
    for (Index front = 0; front < tree.fronts(); ++front)
        border_sizes[front] = static_cast<std::size_t>(tree.shape(front).border);
    const auto plan = [&](StackPlan& stack, const std::vector<std::size_t>& sizes)
    {
        stack = {};
        stack.begin.resize(sizes.size());
        for (const IndexRange& subtree : subtree_)
            stack.add(tree, {subtree.begin, subtree.end - 1}, sizes);
        std::size_t shared = 0;
        for (Index front = 0; front < tree.fronts(); ++front)
            if (is_shared_[front] != 0)
            {
                stack.begin[front] = shared;
                shared += sizes[front];
            }
        return shared;
    };
    const std::size_t shared_borders = plan(border_plan_, border_sizes);
    contributions_.grow(std::max(plan(contribution_plan_, fronts_.contribution_sizes()), shared_borders));
    scratch_.resize(static_cast<std::size_t>(threads));
    for (Scratch& scratch : scratch_)
        scratch.contributions.grow(std::max(contribution_plan_.size, border_plan_.size));
    x_.resize(3 * tree.order.size());
}

double* Factorisation::handed_on(const StackPlan& plan, Index front, Scratch& scratch)
{
    return (is_shared_[front] != 0 ? contributions_ : scratch.contributions).data() + plan.begin[front];
}

Index Factorisation::factor_alone(Index front, const BlockMatrix& matrix, Scratch& scratch)
{
    const FrontTree& tree = fronts_.tree();
    const auto all_rows = [&](Index child) { return IndexRange{0, tree.border_begin[child + 1] - tree.border_begin[child]}; };
    fronts_.clear(front, 0, 1);
    fronts_.add_matrix(front, {0, tree.own(front)}, matrix);
    for (const Index child : tree.children(front))
        fronts_.add_to_factor(child, all_rows(child), handed_on(contribution_plan_, child, scratch));
    fronts_.find_smallest_pivots(front, matrix, smallest_pivot, scratch.smallest);
    double* contribution = handed_on(contribution_plan_, front, scratch);
    const Index failed = factor_front(tree.shape(front), scratch.smallest.data(), fronts_.factor(front), contribution);
    if (failed != no_index)
        return tree.own_begin[front] + failed / 3;
    for (const Index child : tree.children(front))
        fronts_.add_to_contribution(child, all_rows(child), handed_on(contribution_plan_, child, scratch), contribution);
    return no_index;
}

Index Factorisation::factor_subtree(IndexRange fronts, const BlockMatrix& matrix, Scratch& scratch)
{
    for (Index front = fronts.begin; front < fronts.end; ++front)
        if (const Index failed = factor_alone(front, matrix, scratch); failed != no_index)
            return failed;
    return no_index;
}

/// The steps of factor_alone(), each shared out in pieces of rows.
Index Factorisation::factor_together(const Team& team, Index front, const BlockMatrix& matrix)
{
    const FrontTree& tree = fronts_.tree();
    const FrontShape shape = tree.shape(front);
    Scratch& scratch = scratch_[team.member()];
    double* factor = fronts_.factor(front);
    double* contribution = handed_on(contribution_plan_, front, scratch);
    const auto deal = [&](IndexRange range, Index a_piece, const auto& work)
    {
        const Index last = pieces(range.size(), a_piece) - 1;  // first: later rows are longer
        team.deal(last + 1, [&](Index i) { work(piece(range, last - i, a_piece)); });
    };
    const auto deal_rows = [&](Index child, const auto& work) {
        deal({0, tree.border_begin[child + 1] - tree.border_begin[child]}, blocks_a_piece, work);
    };

    fronts_.clear(front, team.member(), team.threads());
    team.barrier();
    deal({0, tree.own(front)}, blocks_a_piece, [&](IndexRange own) { fronts_.add_matrix(front, own, matrix); });
    for (const Index child : tree.children(front))
        deal_rows(child,
                  [&](IndexRange rows) { fronts_.add_to_factor(child, rows, handed_on(contribution_plan_, child, scratch)); });
    for (Index s = 0; s < shape.strips(); ++s)
    {
        const Strip strip = shape.strip(s);
        team.alone(
            [&]
            {
                fronts_.find_smallest_pivots(front, matrix, smallest_pivot, scratch.smallest);
                failed_.back() = factor_diagonal(strip, scratch.smallest.data(), factor);
            });
        if (failed_.back() != no_index)
            return tree.own_begin[front] + failed_.back() / 3;
        const IndexRange below{strip.end_panel(), shape.panels()};
        deal(below, panels_a_piece, [&](IndexRange panels) { solve_panels(strip, panels, factor); });
        deal(below, panels_a_piece, [&](IndexRange panels) { update_panels(shape, s, panels, factor, contribution); });
    }
    for (const Index child : tree.children(front))
        deal_rows(child, [&](IndexRange rows)
                  { fronts_.add_to_contribution(child, rows, handed_on(contribution_plan_, child, scratch), contribution); });
    return no_index;
}

Index Factorisation::factorise(const Team& team, const BlockMatrix& matrix)
{
    team.alone([&] { failed_.assign(subtree_.size() + 1, no_index); });
    team.deal(static_cast<Index>(subtree_.size()),
              [&](Index i) { failed_[i] = factor_subtree(subtree_[i], matrix, scratch_[team.member()]); });
    Index first = no_index;
    for (const Index place : failed_)
        if (place != no_index && (first == no_index || place < first))
            first = place;
    for (std::size_t i = 0; i < top_.size() && first == no_index; ++i)
        first = factor_together(team, top_[i], matrix);
    team.barrier();
    return first == no_index ? no_index : tree().order[first];
}

void Factorisation::forward(Index front, Scratch& scratch)
{
    const FrontShape shape = tree().shape(front);
    fronts_.begin_forward(front, x_.data(), scratch.rows);
    for (const Index child : tree().children(front))
        fronts_.add_to_rows(child, handed_on(border_plan_, child, scratch), scratch.rows);
    solve_forward(shape, fronts_.factor(front), scratch.rows.data());
    std::copy_n(scratch.rows.begin(), shape.own, x_.begin() + 3 * static_cast<std::ptrdiff_t>(tree().own_begin[front]));
    std::copy_n(scratch.rows.begin() + shape.border_row(0), shape.border, handed_on(border_plan_, front, scratch));
}

void Factorisation::backward(Index front, Scratch& scratch)
{
    const FrontShape shape = tree().shape(front);
    fronts_.begin_backward(front, x_.data(), scratch.rows);
    solve_backward(shape, fronts_.factor(front), scratch.rows.data());
    std::copy_n(scratch.rows.begin(), shape.own, x_.begin() + 3 * static_cast<std::ptrdiff_t>(tree().own_begin[front]));
}

void Factorisation::solve(const Team& team, const double* b, double* x)
{
    const std::vector<Index>& order = tree().order;
    const IndexRange mine = team.share(static_cast<Index>(order.size()));
    const auto subtrees = static_cast<Index>(subtree_.size());
    Scratch& scratch = scratch_[team.member()];
    for (Index place = mine.begin; place < mine.end; ++place)
        std::copy_n(b + 3 * static_cast<std::ptrdiff_t>(order[place]), 3, x_.data() + 3 * static_cast<std::ptrdiff_t>(place));
    team.barrier();
    team.deal(subtrees,
              [&](Index i)
              {
                  for (Index front = subtree_[i].begin; front < subtree_[i].end; ++front)
                      forward(front, scratch);
              });
    team.alone(
        [&]
        {
            std::for_each(top_.begin(), top_.end(), [&](Index front) { forward(front, scratch); });
            std::for_each(top_.rbegin(), top_.rend(), [&](Index front) { backward(front, scratch); });
        });
    team.deal(subtrees,
              [&](Index i)
              {
                  for (Index front = subtree_[i].end - 1; front >= subtree_[i].begin; --front)
                      backward(front, scratch);
              });
    for (Index place = mine.begin; place < mine.end; ++place)
        std::copy_n(x_.data() + 3 * static_cast<std::ptrdiff_t>(place), 3, x + 3 * static_cast<std::ptrdiff_t>(order[place]));
    team.barrier();
}
}  // namespace hdem
