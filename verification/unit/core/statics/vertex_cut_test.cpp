#include "core/statics/vertex_cut.h"
#include "verification/unit/core/statics/contact_graphs.h"

#include <gtest/gtest.h>

#include <bit>

namespace hdem
{
namespace
{
using test::ContactGraph;
using test::Random;

BlockGraph graph_of(const ContactGraph& contacts)
{
    BlockMatrix matrix;
    matrix.set_pattern(contacts.blocks(), contacts.pairs);
    return matrix.graph();
}

/// Left of `line`: left, apart from those that touch a block right of it.
GraphCut cut_at(const BlockGraph& graph, const std::vector<Vec2>& places, double line, std::vector<CutSide>& side)
{
    GraphCut cut;
    side.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
        side[i] = places[i].x() < line ? CutSide::left : CutSide::right;
    for (Index i = 0; i < graph.blocks(); ++i)
    {
        const auto near = graph.of(i);
        if (side[i] == CutSide::left &&
            std::any_of(near.begin(), near.end(), [&](Index next) { return side[next] == CutSide::right; }))
            cut.separator.push_back(i);
        else
            ++cut.size[static_cast<int>(side[i])];
    }
    for (const Index i : cut.separator)
        side[i] = CutSide::separator;
    return cut;
}

void expect_separated(const BlockGraph& graph, const std::vector<CutSide>& side, const GraphCut& cut)
{
    std::array<Index, 2> size{};
    std::vector<Index> separator;
    for (Index i = 0; i < graph.blocks(); ++i)
    {
        if (side[i] == CutSide::separator)
            separator.push_back(i);
        else
            ++size[static_cast<int>(side[i])];
        for (const Index next : graph.of(i))
            EXPECT_FALSE(side[i] == CutSide::left && side[next] == CutSide::right) << i << " touches " << next;
    }
    std::vector<Index> told = cut.separator;
    std::sort(told.begin(), told.end());
    EXPECT_EQ(told, separator);
    EXPECT_EQ(cut.size, size);
}

/// Fewest of the blocks in `band` that part the blocks of `left` from those of `right`, tried one set after another.
int fewest(const BlockGraph& graph, const std::vector<Index>& band, const std::vector<CutSide>& side)
{
    int least = static_cast<int>(band.size());
    for (std::uint32_t removed = 0; removed < std::uint32_t{1} << band.size(); ++removed)
    {
        if (std::popcount(removed) >= least)
            continue;
        // Blocks reached from the left.
        std::vector<std::uint8_t> blocked(side.size(), 0);
        for (std::size_t k = 0; k < band.size(); ++k)
            blocked[band[k]] = removed >> k & 1;
        std::vector<Index> found;
        for (Index i = 0; i < graph.blocks(); ++i)
            if (side[i] == CutSide::left && std::find(band.begin(), band.end(), i) == band.end())
                found.push_back(i);
        for (const Index i : found)
            blocked[i] = 1;
        bool reached = false;
        for (std::size_t head = 0; head < found.size(); ++head)
            for (const Index next : graph.of(found[head]))
                if (blocked[next] == 0)
                {
                    blocked[next] = 1;
                    found.push_back(next);
                    reached |= side[next] == CutSide::right && std::find(band.begin(), band.end(), next) == band.end();
                }
        if (!reached)
            least = std::popcount(removed);
    }
    return least;
}

TEST(VertexCut, IsNoLargerThanTheSmallestSetTriedByHand)
{
    Random random(1);
    int smaller = 0;
    for (int trial = 0; trial < 60; ++trial)
    {
        ContactGraph contacts = test::rock_graph(4 + random.below(3), 4, static_cast<std::uint64_t>(trial));
        for (int more = 0; more < trial % 4; ++more)
            contacts.pairs.push_back({random.below(4), 4 + random.below(12)});
        const BlockGraph graph = graph_of(contacts);
        std::vector<CutSide> side;
        GraphCut cut = cut_at(graph, contacts.places, 2.0, side);
        // The band of one layer, while every block may be in it.
        std::vector<Index> band = cut.separator;
        for (const Index i : cut.separator)
            for (const Index next : graph.of(i))
                if (std::find(band.begin(), band.end(), next) == band.end())
                    band.push_back(next);
        const int expected = fewest(graph, band, side);
        const std::size_t before = cut.separator.size();
        VertexCut(graph).shrink(1, 0, side, cut);
        EXPECT_EQ(static_cast<int>(cut.separator.size()), expected) << "trial " << trial;
        expect_separated(graph, side, cut);
        smaller += cut.separator.size() < before ? 1 : 0;
    }
    EXPECT_GT(smaller, 10);
}

/// Two rock masses that one block joins.
TEST(VertexCut, FindsTheBlockThatJoinsTwoMasses)
{
    ContactGraph contacts = test::rock_graph(21, 12);
    std::erase_if(contacts.pairs,
                  [](const CoupledPair& pair) { return pair.b != no_index && (pair.a % 21 == 10) != (pair.b % 21 == 10); });
    contacts.pairs.push_back({5 * 21 + 9, 5 * 21 + 10});
    contacts.pairs.push_back({7 * 21 + 10, 7 * 21 + 11});
    const BlockGraph graph = graph_of(contacts);
    std::vector<CutSide> side;
    GraphCut cut = cut_at(graph, contacts.places, 7.0, side);
    ASSERT_GE(cut.separator.size(), 12u);
    VertexCut search(graph);
    search.shrink(20, 20, side, cut);
    EXPECT_EQ(cut.separator.size(), 1u);
    expect_separated(graph, side, cut);
}

TEST(VertexCut, LeavesAsManyBlocksOnEachSideAsAsked)
{
    const ContactGraph contacts = test::rock_graph(30, 30);
    const BlockGraph graph = graph_of(contacts);
    VertexCut search(graph);
    for (const Index kept : {200, 300, 400, 1000})
    {
        std::vector<CutSide> side;
        GraphCut cut = cut_at(graph, contacts.places, 15.0, side);
        const GraphCut before = cut;
        search.shrink(30, kept, side, cut);
        expect_separated(graph, side, cut);
        for (const int s : {0, 1})
            EXPECT_GE(cut.size[s], std::min(kept, before.size[s]));
        EXPECT_LE(cut.separator.size(), before.separator.size());
    }
}

TEST(VertexCut, LeavesACutWithAnEmptySideAlone)
{
    const ContactGraph contacts = test::crowd_graph(10);
    const BlockGraph graph = graph_of(contacts);
    std::vector<CutSide> side;
    GraphCut cut = cut_at(graph, contacts.places, 0.5, side);
    ASSERT_EQ(cut.size[0], 0);
    const std::vector<Index> separator = cut.separator;
    VertexCut(graph).shrink(4, 0, side, cut);
    EXPECT_EQ(cut.separator, separator);
    expect_separated(graph, side, cut);
}
}  // namespace
}  // namespace hdem
