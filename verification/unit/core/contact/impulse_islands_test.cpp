#include "core/contact/impulse_clusters.h"
#include "core/contact/impulse_islands.h"
#include "core/rock/build_model.h"
#include "parallel/stages.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace hdem
{
namespace
{
ImpulsePoint between(Index ref, Index inc)
{
    ImpulsePoint p;
    p.ref = ref;
    p.inc = inc;
    return p;
}

/// Block 0 is the ground, all others move.
Blocks movable_blocks(int count)
{
    Blocks blocks;
    blocks.motion.resize(static_cast<std::size_t>(count));
    blocks.inertia.assign(static_cast<std::size_t>(count), {1.0, 1.0, 1.0, 0.0});
    blocks.inertia[0] = {};
    return blocks;
}

TEST(ImpulseIslands, AreJoinedByMovableBlocksOnly)
{
    const Blocks blocks = movable_blocks(7);
    // Two columns on the same ground, in two lists; block 6 joins nothing.
    std::vector<ImpulsePoint> first{between(0, 1), between(0, 3), between(2, 1)}, second{between(4, 3), between(0, 5)};
    IslandFinder finder;
    std::vector<Island> islands;
    finder.find({&first, &second}, blocks, islands);
    ASSERT_EQ(islands.size(), 3U);
    EXPECT_EQ(islands[0].points, (std::vector<ImpulsePoint*>{&first[0], &first[2]}));
    EXPECT_EQ(islands[1].points, (std::vector<ImpulsePoint*>{&first[1], &second[0]}));
    EXPECT_EQ(islands[2].points, (std::vector<ImpulsePoint*>{&second[1]}));
    // Nothing is left from before.
    std::vector<ImpulsePoint> third{between(4, 1), between(3, 2)};
    finder.find({&third}, blocks, islands);
    EXPECT_EQ(islands.size(), 2U);
}

TEST(ImpulseIslands, OfAnyLengthAreOne)
{
    constexpr int count = 2000;
    const Blocks blocks = movable_blocks(count);
    std::vector<ImpulsePoint> points;
    for (Index i = count - 1; i > 0; --i)
        points.push_back(between(i - 1, i));
    IslandFinder finder;
    std::vector<Island> islands;
    finder.find({&points}, blocks, islands);
    ASSERT_EQ(islands.size(), 1U);
    EXPECT_EQ(islands[0].points.size(), points.size());
}

void set_mass(Blocks& blocks, Index block, double mass)
{
    blocks.inertia[block].inverse_mass_x = blocks.inertia[block].inverse_mass_y = 1.0 / mass;
}

/// Ground 0, column 1 to 5 with light blocks 2 and 3 between heavy ones; far from them 6, light blocks 7 and 8 between it and the ground, and 9 and 10 on it.
TEST(ImpulseIslands, OfManyPointsAreCutIntoClusters)
{
    Blocks blocks = movable_blocks(11);
    for (const Index heavy : {1, 4, 5, 6})
        set_mass(blocks, heavy, 1000.0);
    std::vector<ImpulsePoint> points{between(0, 1), between(1, 2), between(2, 3), between(3, 4), between(4, 5), between(5, 6),
                                     between(6, 7), between(7, 8), between(0, 8), between(6, 9), between(9, 10)};
    IslandFinder finder;
    std::vector<Island> islands;
    finder.find({&points}, blocks, islands);
    ASSERT_EQ(islands.size(), 1U);
    constexpr Index none = no_index;
    EXPECT_EQ(clusters_of(islands[0], blocks, 100.0), (std::vector<Index>{none, 0, 0, 0, none, none, 1, 1, 1, none, none}));
    EXPECT_TRUE(clusters_of(islands[0], blocks, 1001.0).empty());
    // A beam on all that is light, and a block of middle mass under which the lightest lies.
    set_mass(blocks, 5, 1e6);
    set_mass(blocks, 3, 10.0);
    EXPECT_EQ(clusters_of(islands[0], blocks, 100.0), (std::vector<Index>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, none}));
}

/// Sweeps leave a thousandth of the weight unbalanced, ten times what a block at rest may have.
TEST(ImpulseIslands, ComeToRestWhereRestIsLookedFor)
{
    for (const double angle : {0.0, 23.0, -61.0})
    {
        constexpr int count = 20;
        constexpr double gap = 0.04;
        CaseDef scene = scenes::empty_scene();
        scenes::add_fixed_block(scene, "ground", scenes::rectangle({-2, -1}, {3, 0}));
        for (int i = 0; i < count; ++i)
        {
            const double y = gap + i * (1.0 + gap);
            scenes::add_block(scene, fmt::format("block {}", i), scenes::rectangle({0, y}, {1, y + 1.0}));
        }
        scene.contact.method = Method::impulse;
        scene.time.step = 2e-5;
        scene = scenes::turned(scene, angle);
        scene.stages = {{.name = "fall", .until_converged = true, .max_cycles = 50'000}};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
        EXPECT_TRUE(run_stages(simulation, {})[0].at_rest) << angle;
        double greatest = 0.0;
        for (Index block = 0; block < simulation.state().blocks.size(); ++block)
            greatest = std::max(greatest, simulation.state().blocks.displacement(block).norm());
        EXPECT_NEAR(greatest, count * gap, 1e-3);
    }
}

/// Sweeps leave more on one side than on the other, by the order of the blocks.
TEST(ImpulseIslands, AnImpactOnTwoBlocksIsTheSameOnBothSides)
{
    for (const Method method : {Method::impulse, Method::hybrid})
        for (const double restitution : {0.0, 0.5})
        {
            CaseDef scene = scenes::empty_scene();
            scenes::add_fixed_block(scene, "ground", scenes::rectangle({-5, -1}, {5, 0}));
            scenes::add_block(scene, "left", scenes::rectangle({-1.5, 0}, {-0.1, 1}));
            scenes::add_block(scene, "right", scenes::rectangle({0.1, 0}, {1.5, 1}));
            scenes::add_block(scene, "falls", scenes::rectangle({-1, 1.1}, {1, 2.1})).velocity = {0.0, -3.0};
            scene.contact.method = method;
            scene.contact.restitution = restitution;
            scene.damping.preset = DampingPreset::dynamic;
            test::CaseRun run(scene);
            while (run.velocity("falls").y() < -2.9)
                run.advance();
            run.advance(3);
            constexpr double alike = 3e-5;
            EXPECT_NEAR(run.velocity("falls").x(), 0.0, alike);
            EXPECT_NEAR(run.motion("falls").w, 0.0, alike);
            EXPECT_NEAR(run.velocity("left").x(), -run.velocity("right").x(), alike);
            EXPECT_NEAR(run.velocity("left").y(), run.velocity("right").y(), alike);
            EXPECT_NEAR(run.motion("left").w, -run.motion("right").w, alike);
        }
}

TEST(MassRange, LeavesBlocksThatCannotMoveOut)
{
    MassRange range;
    range.add(BlockInertia{});
    EXPECT_TRUE(range.suits_sweeps(1));
    range.add(BlockInertia{1.0, 1.0, 1.0, 0.0});
    range.add(BlockInertia{0.0, 1.0 / 99.0, 0.0, 0.0});  // moves along y only
    EXPECT_TRUE(range.suits_sweeps(10));
    range.add(BlockInertia{1.0 / 101.0, 1.0 / 101.0, 1.0, 0.0});
    EXPECT_FALSE(range.suits_sweeps(10));
    EXPECT_TRUE(range.suits_sweeps(11));
}
}  // namespace
}  // namespace hdem
