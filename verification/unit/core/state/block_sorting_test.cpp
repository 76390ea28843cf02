#include "core/state/block_sorting.h"
#include "verification/unit/case_run.h"

#include <random>

namespace hdem
{
namespace
{
using test::CaseRun;

/// A wall some cycles after its start, with friction and weight in its contacts.
struct Wall
{
    Model model;
    State state;

    explicit Wall(int side = 75) : Wall(scenes::wall(side, side)) {}
    explicit Wall(const CaseDef& scene)
    {
        CaseRun run(scene);
        run.advance(40);
        model = run.simulation.model();
        state = run.simulation.state();
    }

    /// The same with its blocks in any order in memory.
    void shuffle()
    {
        const Blocks now = state.blocks;
        const std::vector<Index> slot = model.slot_of_user;
        std::mt19937_64 random(7);
        for (BlockMotion& m : state.blocks.motion)
        {
            m.x = static_cast<double>(random() >> 40);
            m.y = static_cast<double>(random() >> 40);
        }
        sort_blocks(model, state);
        for (Index user = 0; user < model.blocks(); ++user)
            state.blocks.motion[model.slot_of_user[user]] = now.motion[slot[user]];
    }
};

TEST(BlockSorting, SeesWhenTheOrderHasDecayed)
{
    Wall wall;
    EXPECT_FALSE(is_order_decayed(wall.model, wall.state));
    wall.shuffle();
    EXPECT_TRUE(is_order_decayed(wall.model, wall.state));
    sort_blocks(wall.model, wall.state);
    EXPECT_FALSE(is_order_decayed(wall.model, wall.state));
}

TEST(BlockSorting, LeavesSmallModelsAlone)
{
    Wall wall(20);
    wall.shuffle();
    EXPECT_FALSE(is_order_decayed(wall.model, wall.state));
}

TEST(BlockSorting, KeepsNamesNumbersStateAndContactHistory)
{
    Wall wall(30);
    wall.state.moving = {{.block = 2}, {.block = 500, .how = FreeMotion::flies}};
    wall.state.creeping = {{.block = 3, .looks = 4, .x = 0.5}, {.block = 600, .by_y = -1e-6}};
    const Wall before = wall;
    wall.shuffle();
    EXPECT_NE(wall.model.user_number, before.model.user_number);
    State sorted = wall.state;
    EXPECT_TRUE(sorted.contacts_outdated);  // the only other change
    sorted.contacts_outdated = before.state.contacts_outdated;
    EXPECT_EQ(state_hash(wall.model, sorted), state_hash(before.model, before.state));
    for (Index user = 0; user < wall.model.blocks(); ++user)
    {
        const Index now = wall.model.slot_of_user[user], then = before.model.slot_of_user[user];
        EXPECT_EQ(wall.model.name[now], before.model.name[then]);
        EXPECT_EQ(wall.state.blocks.displacement(now), before.state.blocks.displacement(then));
    }
}

/// A run keeps pointers to its stages while its blocks are sorted.
TEST(BlockSorting, LeavesStagesWhereTheyAre)
{
    Wall wall;
    wall.shuffle();
    const StageDef* stages = wall.model.stages.data();
    const std::string name = stages->name;
    sort_blocks(wall.model, wall.state);
    ASSERT_EQ(wall.model.stages.data(), stages);
    EXPECT_EQ(stages->name, name);
}

/// A run finds its order decayed, sorts its blocks, and goes on as the run whose blocks were never out of order.
/// Between fixed blocks there are no contacts. Those of blocks that a stage frees are found anew, and blocks may be sorted then.
TEST(BlockSorting, LeavesTheBondOfBlocksThatAStageFrees)
{
    CaseDef scene = scenes::wall(75, 75);
    scene.joints[0].cohesion = 1e5;
    scene.stages = {{.name = "hold", .cycles = 40}, {.name = "free", .cycles = 1}};
    for (std::size_t i = 1; i < scene.blocks.size() / 2; ++i)
    {
        scene.blocks[i].fix_x = scene.blocks[i].fix_y = scene.blocks[i].fix_rotation = true;
        scene.stages[1].free.push_back(scene.blocks[i].name);
    }
    const auto bonded = [&](bool is_shuffled)
    {
        Wall wall(scene);
        if (is_shuffled)
            wall.shuffle();
        wall.state.contacts_outdated = false;  // else they are sorted before the stage
        Simulation simulation(std::move(wall.model), std::move(wall.state));
        simulation.begin_stage(1);
        const Contacts& contacts = simulation.state().contacts;
        return std::count(contacts.law.begin(), contacts.law.begin() + contacts.size(), 0);
    };
    EXPECT_EQ(bonded(true), bonded(false));
}

TEST(BlockSorting, HappensBetweenTwoCyclesOfARun)
{
    Wall wall, shuffled;
    shuffled.shuffle();
    sort_blocks(wall.model, wall.state);  // along the curve through the centroids, as the run will
    Simulation expected(wall.model, wall.state), run(shuffled.model, shuffled.state);
    EXPECT_EQ(run.model().user_number, expected.model().user_number);
    expected.advance(50);
    run.advance(50);
    EXPECT_EQ(state_hash(run.model(), run.state()), state_hash(expected.model(), expected.state()));
    EXPECT_EQ(run.state().ledger.friction, expected.state().ledger.friction);
}
}  // namespace
}  // namespace hdem
