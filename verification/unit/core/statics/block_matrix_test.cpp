#include "core/statics/block_matrix.h"
#include "verification/unit/core/statics/contact_graphs.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace hdem
{
namespace
{
using test::ContactGraph;
using test::Random;

/// What add() should give: the blocks of the matrix by row and column.
using Blocks = std::map<std::array<Index, 2>, Matrix3>;

Blocks summed(const ContactGraph& graph, const std::vector<Matrix6>& stiffness)
{
    Blocks sum;
    for (Index block = 0; block < graph.blocks(); ++block)
        sum[{block, block}] = Matrix3::Zero();
    for (std::size_t i = 0; i < graph.pairs.size(); ++i)
    {
        const std::array<Index, 2> block{graph.pairs[i].a, graph.pairs[i].b};
        for (int row = 0; row < 2; ++row)
            for (int column = 0; column < 2; ++column)
                if (block[row] != no_index && block[column] != no_index)
                    sum.try_emplace({block[row], block[column]}, Matrix3::Zero()).first->second += stiffness[i].block<3, 3>(
                        3 * row, 3 * column);
    }
    return sum;
}

Blocks blocks_of(const BlockMatrix& matrix)
{
    Blocks blocks;
    for (Index row = 0; row < matrix.blocks(); ++row)
    {
        blocks[{row, row}] = matrix.diagonal(row);
        for (Index entry = matrix.graph().begin[row]; entry < matrix.graph().begin[row + 1]; ++entry)
            blocks[{row, matrix.graph().neighbour[entry]}] = matrix.coupling(entry);
    }
    return blocks;
}

std::vector<Matrix6> stiffnesses(const ContactGraph& graph)
{
    Random random(3);
    std::vector<Matrix6> stiffness;
    for (std::size_t i = 0; i < graph.pairs.size(); ++i)
        stiffness.push_back(test::contact_stiffness(random, 0.7));
    return stiffness;
}

TEST(BlockMatrix, SumsTheStiffnessOfPairsInTheirOrder)
{
    for (const ContactGraph& graph : test::awkward_graphs())
    {
        SCOPED_TRACE(graph.name);
        BlockMatrix matrix;
        matrix.set_pattern(graph.blocks(), graph.pairs);
        const std::vector<Matrix6> stiffness = stiffnesses(graph);
        for (Index i = 0; i < static_cast<Index>(stiffness.size()); ++i)
            matrix.add(i, stiffness[i]);
        const Blocks expected = summed(graph, stiffness);
        EXPECT_TRUE(blocks_of(matrix) == expected);

        BlockMatrix other = matrix;
        const auto rows_of = [&](Index i, int side) -> RowPair {
            return {stiffness[i].middleRows<3>(3 * side), stiffness[stiffness.size() - 1 - i].middleRows<3>(3 * side)};
        };
        BlockMatrix::assemble({0, graph.blocks()}, rows_of, matrix, other);
        EXPECT_TRUE(blocks_of(matrix) == expected) << "row by row";
        EXPECT_TRUE(blocks_of(other) == summed(graph, {stiffness.rbegin(), stiffness.rend()})) << "row by row";
    }
}

TEST(BlockMatrix, HasRowsThatAscendAndHoldEachNeighbourOnce)
{
    for (const ContactGraph& graph : test::awkward_graphs())
    {
        SCOPED_TRACE(graph.name);
        BlockMatrix matrix;
        matrix.set_pattern(graph.blocks(), graph.pairs);
        ASSERT_EQ(matrix.blocks(), graph.blocks());
        for (Index row = 0; row < graph.blocks(); ++row)
        {
            const auto near = matrix.graph().of(row);
            EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
            EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
            EXPECT_EQ(std::count(near.begin(), near.end(), row), 0);
        }
    }
}

TEST(BlockMatrix, MultipliesAsTheFullMatrixDoes)
{
    const ContactGraph graph = test::slab_graph(30, 10);
    const BlockMatrix matrix = test::contact_matrix(graph, 1, 0.7);
    const Eigen::VectorXd x = test::random_vector(3 * graph.blocks());
    Eigen::VectorXd y(x.size()), in_parts(x.size());
    matrix.multiply({0, graph.blocks()}, x.data(), y.data());
    const Eigen::VectorXd expected = test::dense(matrix) * x;
    EXPECT_LT((y - expected).norm(), 1e-14 * expected.norm());  // order of the sums
    matrix.multiply({0, 17}, x.data(), in_parts.data());
    matrix.multiply({17, graph.blocks()}, x.data(), in_parts.data());
    EXPECT_TRUE(in_parts == y);
}

TEST(BlockMatrix, GivesTheSymmetricPartOfACoupling)
{
    const ContactGraph graph = test::rock_graph(6, 5);
    const BlockMatrix matrix = test::contact_matrix(graph, 1, 0.7);
    const Eigen::MatrixXd full = test::dense(matrix), part = 0.5 * (full + full.transpose());
    ASSERT_GT((full - part).norm(), 1e-3 * full.norm());
    for (Index row = 0; row < graph.blocks(); ++row)
        for (Index entry = matrix.graph().begin[row]; entry < matrix.graph().begin[row + 1]; ++entry)
            EXPECT_TRUE(matrix.symmetric_coupling(entry) == (part.block<3, 3>(3 * row, 3 * matrix.graph().neighbour[entry])));
}

TEST(BlockMatrix, StartsAnewWithAnotherPattern)
{
    const ContactGraph small = test::rock_graph(3, 3);
    BlockMatrix matrix = test::contact_matrix(test::rock_graph(9, 9));
    matrix.set_pattern(small.blocks(), small.pairs);
    EXPECT_EQ(test::dense(matrix).norm(), 0.0);
    EXPECT_EQ(matrix.blocks(), 9);
}

TEST(BlockMatrix, NamesThePairThatIsWrong)
{
    BlockMatrix matrix;
    const auto message = [&](std::vector<CoupledPair> pairs) -> std::string
    {
        try
        {
            matrix.set_pattern(4, pairs);
        }
        catch (const std::invalid_argument& error)
        {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message({{0, 1}, {2, no_index}}), "");
    EXPECT_EQ(message({{0, 1}, {2, 4}}), "pair 1: blocks = 2, 4 (there are 4 blocks).");
    EXPECT_EQ(message({{-2, 1}}), "pair 0: blocks = -2, 1 (there are 4 blocks).");
    EXPECT_EQ(message({{3, 3}}), "pair 0: blocks = 3, 3 (a block does not touch itself).");
    EXPECT_THROW(matrix.set_pattern(-1, {}), std::invalid_argument);
}
}  // namespace
}  // namespace hdem
