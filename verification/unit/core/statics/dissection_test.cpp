#include "core/statics/dissection.h"
#include "verification/unit/core/statics/contact_graphs.h"
#include "verification/unit/core/statics/symbolic.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::ContactGraph;

BlockGraph graph_of(const ContactGraph& contacts)
{
    BlockMatrix matrix;
    matrix.set_pattern(contacts.blocks(), contacts.pairs);
    return matrix.graph();
}

/// Blocks of the factor per block of the matrix.
double fill(const ContactGraph& contacts)
{
    const BlockGraph graph = graph_of(contacts);
    const EliminationOrder order = dissect(graph, contacts.places);
    return static_cast<double>(test::count_entries(test::factor_columns(graph, order.order))) / contacts.blocks();
}

TEST(Dissection, OrdersEachBlockOnceInFrontsThatAreNotEmpty)
{
    for (const ContactGraph& contacts : test::awkward_graphs())
    {
        SCOPED_TRACE(contacts.name);
        const EliminationOrder order = dissect(graph_of(contacts), contacts.places);
        EXPECT_TRUE(test::is_permutation(order.order, contacts.blocks()));
        ASSERT_FALSE(order.front_begin.empty());
        EXPECT_EQ(order.front_begin.front(), 0);
        EXPECT_EQ(order.front_begin.back(), contacts.blocks());
        EXPECT_EQ(std::adjacent_find(order.front_begin.begin(), order.front_begin.end(), std::greater_equal<>()),
                  order.front_begin.end());
    }
}

/// George's bound for a square of n blocks that touch eight others is 7.75 n log2 n: 108 blocks of the factor for each of 128 x 128. Good orders leave a quarter of that.
TEST(Dissection, LeavesAFactorThatGrowsHardlyFasterThanTheMatrix)
{
    const double small = fill(test::rock_graph(32, 32)), large = fill(test::rock_graph(128, 128));
    EXPECT_LT(large, 25.0);          // row by row it would be 128
    EXPECT_LT(large - small, 10.0);  // two more levels
}

/// Cut in the middle, a block of a column has two neighbours at most when its turn comes.
TEST(Dissection, FillsNextToNothingInAColumnOrUnderASlab)
{
    EXPECT_LT(fill(test::column_graph(5000)), 3.0);
    EXPECT_LT(fill(test::slab_graph(5000, 1)), 4.0);  // and the slab
    EXPECT_EQ(fill(test::loose_graph(1000)), 1.0);
}

/// Where the places say nothing, contacts do.
TEST(Dissection, FindsItsWayWithoutPlaces)
{
    const ContactGraph rock = test::rock_graph(50, 50);
    EXPECT_LT(fill(test::at_one_point(test::renumbered(rock))), 1.3 * fill(rock));
}

TEST(Dissection, GivesPiecesThatDoNotTouchNoMoreThanEachWouldHave)
{
    const ContactGraph pieces = test::pieces_graph();
    const double single = 143.0 * fill(test::rock_graph(13, 11, 2)) + 200.0 * fill(test::rock_graph(5, 40, 3)) +
                          400.0 * fill(test::rock_graph(20, 20, 4)) + 2.0;
    EXPECT_LT(fill(pieces) * pieces.blocks(), 1.1 * single);
}

TEST(Dissection, CutsSoThatNoBlockTouchesTheOtherSide)
{
    for (const ContactGraph& contacts : test::awkward_graphs())
    {
        SCOPED_TRACE(contacts.name);
        if (contacts.blocks() < 2)
            continue;
        const BlockGraph graph = graph_of(contacts);
        std::vector<Index> blocks(contacts.places.size());
        std::iota(blocks.begin(), blocks.end(), 0);
        const std::array<Index, 3> size = Dissector(graph, contacts.places).cut(blocks);
        ASSERT_TRUE(test::is_permutation(blocks, contacts.blocks()));
        ASSERT_EQ(size[0] + size[1] + size[2], contacts.blocks());
        for (const Index part : size)
            EXPECT_LT(part, contacts.blocks());
        for (Index i = 0; i < size[0]; ++i)
            for (const Index next : graph.of(blocks[i]))
                EXPECT_EQ(std::count(blocks.begin() + size[0], blocks.begin() + size[0] + size[1], next), 0);
    }
}

/// Three fronts meet in a tree: its leaves go first, and nothing is filled in.
TEST(MinimumDegree, FillsNothingInATree)
{
    ContactGraph tree{"tree"};
    test::Random random(3);
    for (Index i = 0; i < 100; ++i)
    {
        tree.places.emplace_back(0.0, 0.0);
        if (i > 0)
            tree.pairs.push_back({random.below(i), i});
    }
    const BlockGraph graph = graph_of(tree);
    std::vector<Index> order(100), front_size;
    std::iota(order.begin(), order.end(), 0);
    MinimumDegree(graph).order(order, front_size);
    ASSERT_TRUE(test::is_permutation(order, 100));
    EXPECT_EQ(test::count_entries(test::factor_columns(graph, order)), 100 + 99);
    EXPECT_EQ(std::accumulate(front_size.begin(), front_size.end(), 0), 100);
}

/// By hand: the blocks of a square ring. Each of the four has two neighbours; the first leaves an edge more, the others go together.
TEST(MinimumDegree, EliminatesTogetherWhatTouchesTheSame)
{
    ContactGraph ring{"ring", {4, Vec2(0.0, 0.0)}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
    std::vector<Index> order{0, 1, 2, 3}, front_size;
    const BlockGraph graph = graph_of(ring);
    MinimumDegree(graph).order(order, front_size);
    EXPECT_EQ(order, (std::vector<Index>{0, 1, 2, 3}));
    EXPECT_EQ(front_size, (std::vector<Index>{1, 3}));
}

/// Blocks around the set are eliminated later: they count as neighbours, and whoever touches many of them waits.
TEST(MinimumDegree, CountsNeighboursAroundTheSet)
{
    ContactGraph star{"star", {9, Vec2(0.0, 0.0)}, {{0, 1}, {1, 2}}};
    for (Index around = 3; around < 9; ++around)
        star.pairs.push_back({0, around});
    std::vector<Index> order{0, 1, 2}, front_size;
    const BlockGraph graph = graph_of(star);
    MinimumDegree(graph).order(order, front_size);
    EXPECT_EQ(order, (std::vector<Index>{2, 1, 0}));
}
}  // namespace
}  // namespace hdem
