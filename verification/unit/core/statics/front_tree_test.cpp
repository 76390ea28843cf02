#include "core/statics/front_tree.h"
#include "verification/unit/core/statics/contact_graphs.h"
#include "verification/unit/core/statics/symbolic.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::ContactGraph;

struct Case
{
    ContactGraph contacts;
    BlockGraph graph;
    FrontTree tree;

    explicit Case(const ContactGraph& which) : contacts(which)
    {
        BlockMatrix matrix;
        matrix.set_pattern(contacts.blocks(), contacts.pairs);
        graph = matrix.graph();
        tree = make_front_tree(graph, dissect(graph, contacts.places));
    }
};

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const ContactGraph& contacts : test::awkward_graphs())
        all.emplace_back(contacts);
    return all;
}

TEST(FrontTree, EliminatesEachBlockOnceAndChildrenFirst)
{
    for (const Case& c : cases())
    {
        SCOPED_TRACE(c.contacts.name);
        const FrontTree& tree = c.tree;
        EXPECT_TRUE(test::is_permutation(tree.order, c.contacts.blocks()));
        for (std::size_t i = 0; i < tree.order.size(); ++i)
            EXPECT_EQ(tree.place[tree.order[i]], static_cast<Index>(i));
        for (Index front = 0; front < tree.fronts(); ++front)
        {
            EXPECT_GT(tree.own(front), 0);
            EXPECT_EQ(tree.parent[front] == no_index, tree.border_of(front).empty());
            Index before = front;  // subtrees stand one before the other, right before their parent
            const auto children = tree.children(front);
            for (auto child = children.rbegin(); child != children.rend(); ++child)
            {
                EXPECT_EQ(*child, before - 1);
                EXPECT_EQ(tree.parent[*child], front);
                while (before > 0 &&
                       [&](Index f)
                       {
                           while (f != no_index && f != *child)
                               f = tree.parent[f];
                           return f == *child;
                       }(before - 1))
                    --before;
            }
        }
    }
}

TEST(FrontTree, HasRoomForAllThatEliminationFillsIn)
{
    for (const Case& c : cases())
    {
        SCOPED_TRACE(c.contacts.name);
        const FrontTree& tree = c.tree;
        const auto columns = test::factor_columns(c.graph, tree.order);
        double stored = 0.0;
        for (Index front = 0; front < tree.fronts(); ++front)
        {
            const auto border = tree.border_of(front);
            ASSERT_TRUE(std::is_sorted(border.begin(), border.end()));
            const Index end = tree.own_begin[front + 1];
            for (Index place = tree.own_begin[front]; place < end; ++place)
                for (const Index later : columns[place])
                    EXPECT_TRUE(later < end || std::binary_search(border.begin(), border.end(), later));
            const double own = tree.own(front);
            stored += own * (own + 1.0) / 2.0 + own * static_cast<double>(border.size());
        }
        // A quarter of a front may be zeros, and a separator is taken as full.
        EXPECT_LE(stored, 1.45 * test::count_entries(columns));
    }
}

TEST(FrontTree, KnowsTheRowsOfTheParent)
{
    for (const Case& c : cases())
    {
        SCOPED_TRACE(c.contacts.name);
        const FrontTree& tree = c.tree;
        for (Index front = 0; front < tree.fronts(); ++front)
            for (Index i = tree.border_begin[front]; i < tree.border_begin[front + 1]; ++i)
            {
                const Index parent = tree.parent[front], row = tree.row_in_parent[i];
                ASSERT_LT(row, tree.own(parent) + static_cast<Index>(tree.border_of(parent).size()));
                EXPECT_EQ(row < tree.own(parent) ? tree.own_begin[parent] + row : tree.border_of(parent)[row - tree.own(parent)],
                          tree.border[i]);
            }
    }
}

/// A front of one block costs more to start than to eliminate.
TEST(FrontTree, JoinsSmallFronts)
{
    const Case rock(test::rock_graph(60, 60));
    EXPECT_LT(rock.tree.fronts(), 60 * 60 / 2);
}
}  // namespace
}  // namespace hdem
