#include "core/statics/multifrontal.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr Index strip_blocks = strip_columns / 3;

/// Row of the front at which a block row begins.
Index first_row(const FrontShape& shape, Index block_row)
{
    const Index own_blocks = shape.own / 3;
    return block_row < own_blocks ? 3 * block_row : shape.border_row(3 * (block_row - own_blocks));
}

/// Row of a strip, as if it began with column 0 of the front.
double* strip_row(const Strip& strip, Index row, double* factor)
{
    return factor + strip.panel(row / lanes) + row % lanes - static_cast<std::ptrdiff_t>(strip.first) * lanes;
}

/// Row of what a front hands on.
template <typename Number>
Number* contribution_row(const FrontShape& shape, Index row, Number* contribution)
{
    return contribution + shape.contribution_panel(row / lanes) + row % lanes;
}

/// Add the columns of blocks [begin, end) of row `r` of border block `s`, up to the diagonal, to a row of the parent, where the column of a block is
/// that of its row there, less `shift`.
void add_row(const double* from, const Index* row_in_parent, Index begin, Index end, Index s, Index r, Index shift, double* to)
{
    for (Index t = begin; t < std::min(end, s); ++t)
    {
        const double* source = from + 3 * t * lanes;
        double* target = to + 3 * static_cast<std::ptrdiff_t>(row_in_parent[t] - shift) * lanes;
        for (Index c = 0; c < 3; ++c)
            target[c * lanes] += source[c * lanes];
    }
    if (s < end)
        for (Index c = 0; c <= r; ++c)
            to[(3 * static_cast<std::ptrdiff_t>(row_in_parent[s] - shift) + c) * lanes] += from[(3 * s + c) * lanes];
}
}  // namespace

void StackPlan::add(const FrontTree& tree, IndexRange fronts, const std::vector<std::size_t>& sizes)
{
    begin.resize(static_cast<std::size_t>(tree.fronts()));
    std::vector<std::uint8_t> is_odd(static_cast<std::size_t>(fronts.size()), 0);
    for (Index front = fronts.end - 1; front >= fronts.begin; --front)
        if (const Index parent = tree.parent[front]; parent != no_index && parent < fronts.end)
            is_odd[front - fronts.begin] = 1 - is_odd[parent - fronts.begin];
    std::array<std::size_t, 2> used{}, most{};
    for (Index front = fronts.begin; front < fronts.end; ++front)
    {
        const int own = is_odd[front - fronts.begin];
        begin[front] = used[own];
        used[own] += sizes[front];
        most[own] = std::max(most[own], used[own]);
        for (const Index child : tree.children(front))
            used[1 - own] -= sizes[child];
    }
    for (Index front = fronts.begin; front < fronts.end; ++front)
        if (is_odd[front - fronts.begin] != 0)
            begin[front] += most[0];
    size = std::max(size, most[0] + most[1]);
}

void Multifrontal::set_pattern(const BlockGraph& graph, FrontTree tree)
{
    tree_ = std::move(tree);
    entry_row_.assign(graph.neighbour.size(), no_index);
    factor_begin_.assign(1, 0);
    for (Index front = 0; front < tree_.fronts(); ++front)
    {
        factor_begin_.push_back(factor_begin_.back() + tree_.shape(front).factor_size());
        const auto border = tree_.border_of(front);
        const Index begin = tree_.own_begin[front], end = tree_.own_begin[front + 1];
        for (Index place = begin; place < end; ++place)
        {
            const Index block = tree_.order[place];
            for (Index entry = graph.begin[block]; entry < graph.begin[block + 1]; ++entry)
            {
                const Index other = tree_.place[graph.neighbour[entry]];
                if (other > place)
                    entry_row_[entry] = other < end ? other - begin
                                                    : end - begin +
                                                          static_cast<Index>(std::lower_bound(border.begin(), border.end(), other) -
                                                                             border.begin());
            }
        }
    }
    factor_.grow(factor_size());
}

std::vector<std::size_t> Multifrontal::contribution_sizes() const
{
    std::vector<std::size_t> sizes(static_cast<std::size_t>(tree_.fronts()));
    for (Index front = 0; front < tree_.fronts(); ++front)
        sizes[front] = tree_.shape(front).contribution_size();
    return sizes;
}

void Multifrontal::clear(Index front, int share, int shares)
{
    const std::size_t size = factor_begin_[front + 1] - factor_begin_[front];
    std::fill(factor(front) + size * share / shares, factor(front) + size * (share + 1) / shares, 0.0);
}

void Multifrontal::add_matrix(Index front, IndexRange own_blocks, const BlockMatrix& matrix)
{
    const FrontShape shape = tree_.shape(front);
    const BlockGraph& graph = matrix.graph();
    for (Index q = own_blocks.begin; q < own_blocks.end; ++q)
    {
        const Index block = tree_.order[tree_.own_begin[front] + q];
        const Strip strip = shape.strip(q / strip_blocks);
        const auto row_from_block = [&](Index row)
        { return strip_row(strip, row, factor(front)) + 3 * static_cast<std::ptrdiff_t>(q) * lanes; };
        const Matrix3& diagonal = matrix.diagonal(block);
        for (Index r = 0; r < 3; ++r)
        {
            double* to = row_from_block(3 * q + r);
            for (Index c = 0; c <= r; ++c)
                to[c * lanes] = 0.5 * (diagonal(r, c) + diagonal(c, r));
        }
        for (Index entry = graph.begin[block]; entry < graph.begin[block + 1]; ++entry)
        {
            if (entry_row_[entry] == no_index)
                continue;
            const Index first = first_row(shape, entry_row_[entry]);
            const Matrix3 coupling = matrix.symmetric_coupling(entry);
            for (Index r = 0; r < 3; ++r)
            {
                double* to = row_from_block(first + r);
                for (Index c = 0; c < 3; ++c)
                    to[c * lanes] = coupling(c, r);
            }
        }
    }
}

void Multifrontal::add_to_factor(Index child, IndexRange rows, const double* child_contribution)
{
    const Index front = tree_.parent[child];
    const FrontShape shape = tree_.shape(front), child_shape = tree_.shape(child);
    const Index* row_in_parent = tree_.row_in_parent.data() + tree_.border_begin[child];
    const auto find = [&](Index row)
    { return static_cast<Index>(std::lower_bound(row_in_parent, row_in_parent + rows.end, row) - row_in_parent); };
    const Index own = find(tree_.own(front));
    for (Index begin = 0, end = 0; begin < own; begin = end)  // strip by strip
    {
        const Index number = row_in_parent[begin] / strip_blocks;
        const Strip strip = shape.strip(number);
        end = std::min(own, find((number + 1) * strip_blocks));
        for (Index s = std::max(rows.begin, begin); s < rows.end; ++s)
            for (Index r = 0; r < 3; ++r)
                add_row(contribution_row(child_shape, child_shape.border_row(3 * s + r), child_contribution), row_in_parent, begin,
                        end, s, r, 0, strip_row(strip, first_row(shape, row_in_parent[s]) + r, factor(front)));
    }
}

void Multifrontal::add_to_contribution(Index child, IndexRange rows, const double* child_contribution, double* contribution) const
{
    const Index front = tree_.parent[child];
    const FrontShape shape = tree_.shape(front), child_shape = tree_.shape(child);
    const Index own = tree_.own(front);
    const Index* row_in_parent = tree_.row_in_parent.data() + tree_.border_begin[child];
    const auto first = static_cast<Index>(std::lower_bound(row_in_parent, row_in_parent + rows.end, own) - row_in_parent);
    for (Index s = std::max(first, rows.begin); s < rows.end; ++s)
        for (Index r = 0; r < 3; ++r)
            add_row(contribution_row(child_shape, child_shape.border_row(3 * s + r), child_contribution), row_in_parent, first,
                    rows.end, s, r, own, contribution_row(shape, first_row(shape, row_in_parent[s]) + r, contribution));
}

void Multifrontal::find_smallest_pivots(Index front, const BlockMatrix& matrix, double share, std::vector<double>& smallest) const
{
    smallest.clear();
    for (Index place = tree_.own_begin[front]; place < tree_.own_begin[front + 1]; ++place)
        for (Index i = 0; i < 3; ++i)
            smallest.push_back(share * std::max(matrix.diagonal(tree_.order[place])(i, i), 0.0));
}

void Multifrontal::begin_forward(Index front, const double* x, std::vector<double>& rows) const
{
    const FrontShape shape = tree_.shape(front);
    rows.assign(static_cast<std::size_t>(shape.panels()) * lanes, 0.0);
    std::copy_n(x + 3 * static_cast<std::ptrdiff_t>(tree_.own_begin[front]), shape.own, rows.begin());
}

void Multifrontal::add_to_rows(Index child, const double* child_border, std::vector<double>& rows) const
{
    const FrontShape shape = tree_.shape(tree_.parent[child]);
    for (Index i = tree_.border_begin[child]; i < tree_.border_begin[child + 1]; ++i, child_border += 3)
    {
        double* row = rows.data() + first_row(shape, tree_.row_in_parent[i]);
        for (Index r = 0; r < 3; ++r)
            row[r] += child_border[r];
    }
}

void Multifrontal::begin_backward(Index front, const double* x, std::vector<double>& rows) const
{
    begin_forward(front, x, rows);
    double* row = rows.data() + tree_.shape(front).border_row(0);
    for (const Index place : tree_.border_of(front))
    {
        std::copy_n(x + 3 * static_cast<std::ptrdiff_t>(place), 3, row);
        row += 3;
    }
}
}  // namespace hdem
