#include "parallel/partition.h"
#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using test::CaseRun;

Partition coloured(const State& state)
{
    Partition partition;
    make_partition(state, true, partition);
    return partition;
}

template <typename Part>
void expect_to_cover(const std::vector<Part>& parts, Index size)
{
    Index at = 0;
    for (const Part& part : parts)
    {
        EXPECT_EQ(part.range.begin, at);
        EXPECT_GT(part.range.size(), 0);
        at = part.range.end;
    }
    EXPECT_EQ(at, size);
}

TEST(Partition, HoldsEachContactAndEachBlockOnce)
{
    const CaseRun run(scenes::wall(20, 20));
    const Partition partition = coloured(run.state());
    expect_to_cover(partition.contacts, run.state().contacts.size());
    expect_to_cover(partition.blocks, run.state().blocks.size());
}

TEST(Partition, CutsContactsWhereALaneGroupBegins)
{
    const CaseRun run(scenes::voronoi(15, 15));
    for (const ContactPart& part : coloured(run.state()).contacts)
        EXPECT_EQ(part.range.begin % lanes, 0);
}

TEST(Partition, GivesEachPartOneColour)
{
    const CaseRun run(scenes::joints(25.0, 25.0, 1.0, 5.0));
    const Partition partition = coloured(run.state());
    std::vector<int> seen(partition.contacts.size(), 0);
    for (const std::vector<Index>& colour : partition.colours)
        for (const Index part : colour)
            ++seen[part];
    for (const int times : seen)
        EXPECT_EQ(times, 1);
    EXPECT_GT(partition.colours.size(), 1);
    EXPECT_LT(partition.colours.size(), partition.contacts.size());
}

TEST(Partition, LetsNoTwoPartsOfAColourShareAMovableBlock)
{
    for (const CaseDef& scene : {scenes::wall(30, 30), scenes::joints(25.0, 25.0, 1.0, 5.0), scenes::grid(30, 30)})
    {
        const CaseRun run(scene);
        const Partition partition = coloured(run.state());
        const Contacts& contacts = run.state().contacts;
        for (const std::vector<Index>& colour : partition.colours)
        {
            std::vector<Index> owner(static_cast<std::size_t>(run.state().blocks.size()), no_index);
            for (const Index part : colour)
                for (Index i = partition.contacts[part].range.begin; i < partition.contacts[part].range.end; ++i)
                    for (const Index block : {contacts.ref[i], contacts.inc[i]})
                    {
                        if (!run.state().blocks.is_free(block))
                            continue;
                        EXPECT_TRUE(owner[block] == no_index || owner[block] == part) << "block " << block;
                        owner[block] = part;
                    }
        }
    }
}

TEST(Partition, HasNoColoursUnlessAsked)
{
    const CaseRun run(scenes::wall(5, 5));
    Partition partition;
    make_partition(run.state(), false, partition);
    EXPECT_TRUE(partition.colours.empty());
}
}  // namespace
}  // namespace hdem
