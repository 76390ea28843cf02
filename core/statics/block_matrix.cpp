#include "core/statics/block_matrix.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hdem
{
namespace
{
void check(Index blocks, std::span<const CoupledPair> pairs)
{
    const auto fail = [](std::size_t i, const CoupledPair& pair, const std::string& why)
    {
        throw std::invalid_argument("pair " + std::to_string(i) + ": blocks = " + std::to_string(pair.a) + ", " +
                                    std::to_string(pair.b) + " (" + why + ").");
    };
    if (blocks < 0)
        throw std::invalid_argument("blocks = " + std::to_string(blocks) + " (must not be negative).");
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
        for (const Index block : {pairs[i].a, pairs[i].b})
            if (block < no_index || block >= blocks)
                fail(i, pairs[i], "there are " + std::to_string(blocks) + " blocks");
        if (pairs[i].a == pairs[i].b && pairs[i].a != no_index)
            fail(i, pairs[i], "a block does not touch itself");
    }
}

bool is_coupling(const CoupledPair& pair)
{
    return pair.a != no_index && pair.b != no_index;
}

/// Ends of rows from their lengths, which stand one place later.
void add_up(std::vector<Index>& begin)
{
    for (std::size_t i = 1; i < begin.size(); ++i)
        begin[i] += begin[i - 1];
}

BlockGraph make_graph(Index blocks, std::span<const CoupledPair> pairs)
{
    BlockGraph graph;
    graph.begin.assign(static_cast<std::size_t>(blocks) + 1, 0);
    for (const CoupledPair& pair : pairs)
        if (is_coupling(pair))
        {
            ++graph.begin[pair.a + 1];
            ++graph.begin[pair.b + 1];
        }
    add_up(graph.begin);
    graph.neighbour.resize(static_cast<std::size_t>(graph.begin.back()));
    std::vector<Index> end(graph.begin.begin(), graph.begin.end() - 1);
    for (const CoupledPair& pair : pairs)
        if (is_coupling(pair))
        {
            graph.neighbour[end[pair.a]++] = pair.b;
            graph.neighbour[end[pair.b]++] = pair.a;
        }
    Index kept = 0;
    for (Index block = 0; block < blocks; ++block)
    {
        const Index first = graph.begin[block];
        std::sort(graph.neighbour.begin() + first, graph.neighbour.begin() + end[block]);
        graph.begin[block] = kept;
        for (Index entry = first; entry < end[block]; ++entry)
            if (entry == first || graph.neighbour[entry] != graph.neighbour[kept - 1])
                graph.neighbour[kept++] = graph.neighbour[entry];
    }
    graph.begin.back() = kept;
    graph.neighbour.resize(static_cast<std::size_t>(kept));
    return graph;
}

Index find_entry(const BlockGraph& graph, Index row, Index column)
{
    const auto begin = graph.neighbour.begin();
    return static_cast<Index>(std::lower_bound(begin + graph.begin[row], begin + graph.begin[row + 1], column) - begin);
}
}  // namespace

void BlockMatrix::set_pattern(Index blocks, std::span<const CoupledPair> pairs)
{
    check(blocks, pairs);
    graph_ = make_graph(blocks, pairs);
    pairs_.assign(pairs.begin(), pairs.end());

    half_.resize(graph_.neighbour.size());
    Index half = 0;
    for (Index row = 0; row < blocks; ++row)
        for (Index entry = graph_.begin[row]; entry < graph_.begin[row + 1]; ++entry)
            if (const Index column = graph_.neighbour[entry]; row < column)
            {
                half_[entry] = half;
                half_[find_entry(graph_, column, row)] = half + 1;
                half += 2;
            }
    half_of_.resize(pairs.size());
    std::transform(pairs.begin(), pairs.end(), half_of_.begin(),
                   [&](const CoupledPair& pair)
                   { return is_coupling(pair) ? half_[find_entry(graph_, pair.a, pair.b)] : no_index; });

    list_begin_.assign(static_cast<std::size_t>(blocks) + 1, 0);
    const auto for_sides = [&](const auto& visit)
    {
        for (Index i = 0; i < static_cast<Index>(pairs.size()); ++i)
        {
            if (pairs[i].a != no_index)
                visit(pairs[i].a, 2 * i);
            if (pairs[i].b != no_index)
                visit(pairs[i].b, 2 * i + 1);
        }
    };
    for_sides([&](Index block, Index) { ++list_begin_[block + 1]; });
    add_up(list_begin_);
    list_.resize(static_cast<std::size_t>(list_begin_.back()));
    std::vector<Index> end(list_begin_.begin(), list_begin_.end() - 1);
    for_sides([&](Index block, Index side) { list_[end[block]++] = side; });

    diagonal_.resize(static_cast<std::size_t>(blocks));
    coupling_.resize(static_cast<std::size_t>(half));
    set_zero();
}

void BlockMatrix::set_zero()
{
    std::fill(diagonal_.begin(), diagonal_.end(), Matrix3::Zero());
    std::fill(coupling_.begin(), coupling_.end(), Matrix3::Zero());
}

void BlockMatrix::set_row_zero(Index row)
{
    diagonal_[row].setZero();
    for (Index entry = graph_.begin[row]; entry < graph_.begin[row + 1]; ++entry)
        coupling_[half_[entry]].setZero();
}

void BlockMatrix::add_row(Index pair, int side, const Matrix36& rows)
{
    const Index block = side == 0 ? pairs_[pair].a : pairs_[pair].b;
    diagonal_[block] += rows.middleCols<3>(3 * side);
    if (const Index half = half_of_[pair]; half != no_index)
        coupling_[half ^ side] += rows.middleCols<3>(3 - 3 * side);
}

void BlockMatrix::add(Index pair, const Matrix6& stiffness)
{
    if (pairs_[pair].a != no_index)
        add_row(pair, 0, stiffness.topRows<3>());
    if (pairs_[pair].b != no_index)
        add_row(pair, 1, stiffness.bottomRows<3>());
}

void BlockMatrix::multiply(IndexRange rows, const double* x, double* y) const
{
    using Eigen::Vector3d;
    for (Index row = rows.begin; row < rows.end; ++row)
    {
        Vector3d sum = diagonal_[row] * Vector3d::Map(x + 3 * static_cast<std::ptrdiff_t>(row));
        for (Index entry = graph_.begin[row]; entry < graph_.begin[row + 1]; ++entry)
            sum += coupling_[half_[entry]] * Vector3d::Map(x + 3 * static_cast<std::ptrdiff_t>(graph_.neighbour[entry]));
        Vector3d::Map(y + 3 * static_cast<std::ptrdiff_t>(row)) = sum;
    }
}
}  // namespace hdem
