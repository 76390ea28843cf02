#include "io/checkpoint.h"
#include "verification/unit/case_run.h"
#include "verification/unit/small_run.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hdem
{
namespace
{
using test::CaseRun;

/// The order of summation does not know the number of threads: the same to the last bit.
class Threads : public testing::TestWithParam<int>
{
  protected:
    static void expect_hash_of_one_thread(const CaseDef& scene, std::int64_t cycles)
    {
        CaseRun one(scene, 1), many(scene, GetParam());
        ASSERT_EQ(many.simulation.threads(), GetParam());
        one.advance(cycles);
        many.advance(cycles);
        EXPECT_GT(one.simulation.contact_point_updates(), 500);
        EXPECT_EQ(one.hash(), many.hash());
        EXPECT_EQ(one.simulation.contact_point_updates(), many.simulation.contact_point_updates());
        EXPECT_EQ(one.energy(), many.energy());
    }
};

TEST_P(Threads, GiveTheSamePileByEveryMethod)
{
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
    {
        CaseDef scene = scenes::pile(40, 8);
        scene.contact.method = method;
        expect_hash_of_one_thread(scene, 6000);
    }
}

TEST_P(Threads, GiveTheSameRockAndTheSameExcavation)
{
    CaseDef scene = scenes::joints(20.0, 20.0, 1.0, 3.0);
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {10.0, 10.0}, .diameter = 6.0}};
    scene.stages = {{.name = "dig", .cycles = 10, .excavate = {"tunnel"}}};
    expect_hash_of_one_thread(scene, 1500);
}

/// Steps that vary.
TEST_P(Threads, GiveTheSameFallOfLooseBlocks)
{
    CaseDef scene = scenes::joints(20.0, 20.0, 1.0, 3.0);
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {10.0, 10.0}, .diameter = 6.0}};
    scene.stages = {{.name = "dig", .until_converged = true, .max_cycles = 100'000, .excavate = {"tunnel"}}};
    scene.convergence.loose_distance = 1e-4;
    expect_hash_of_one_thread(scene, 2000);
    CaseRun run(scene);
    run.advance(2000);
    EXPECT_NE(run.state().blocks.step.next, run.model().time_step);
}

TEST_P(Threads, GiveTheSameWallOfTenThousandBricks)
{
    CaseDef scene = scenes::wall(100, 100);
    for (const Method method : {Method::force, Method::hybrid})
    {
        scene.contact.method = method;
        expect_hash_of_one_thread(scene, 60);
    }
}

/// So many impulse points that the threads share the colours.
TEST_P(Threads, GiveTheSameImpulsesInTheOrderOfColours)
{
    CaseDef scene = scenes::wall(30, 30);
    scene.contact.method = Method::impulse;
    expect_hash_of_one_thread(scene, 100);
    CaseDef fall = scenes::pile(900, 30);
    fall.contact.method = Method::impulse;
    expect_hash_of_one_thread(fall, 3000);
}

TEST_P(Threads, MayBeMoreThanThereAreBlocks)
{
    expect_hash_of_one_thread(scenes::stack(2), 1000);
}

ThreadRule shuffled(std::uint32_t seed)
{
    ThreadRule rule{3, ThreadRule::Kind::shuffled};
    rule.seed = seed;
    return rule;
}

/// Every few cycles another number; the run is cut by a checkpoint and goes on with other numbers.
void expect_same_with_changing_threads(const CaseDef& scene, std::int64_t cycles)
{
    CaseRun one(scene, 1);
    one.advance(cycles);
    for (const std::uint32_t seed : {1U, 2U})
    {
        const test::ScratchFolder folder("shuffled");
        const std::int64_t cut = cycles / 2 + 7 * seed;
        CaseRun first(scene, shuffled(seed));
        first.advance(cut);
        EXPECT_GE(first.simulation.thread_choice().use().changes.size(), 2U);
        write_checkpoint(folder.path(), {}, first.model(), first.state());
        Setup setup = build_model(scene);
        State state = CheckpointReader(checkpoint_file(folder.path())).state(setup.model);
        Simulation second(std::move(setup.model), std::move(state), shuffled(seed + 10));
        second.advance(cycles - cut);
        EXPECT_EQ(state_hash(second.model(), second.state()), one.hash()) << name_of(scene.contact.method) << ", seed " << seed;
    }
}

TEST(ChangingThreads, GiveTheSameRockAndTheSameExcavationByEveryMethod)
{
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
    {
        CaseDef scene = scenes::joints(30.0, 30.0, 1.0, 3.0);
        scene.contact.method = method;
        scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {15.0, 15.0}, .diameter = 6.0}};
        scene.stages = {{.name = "dig", .cycles = 10, .excavate = {"tunnel"}}};
        expect_same_with_changing_threads(scene, method == Method::force ? 400 : 200);  // many barriers a cycle
    }
}

/// Impulse points enough for all threads to share the colours.
TEST(ChangingThreads, GiveTheSameWallByEveryMethod)
{
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
    {
        CaseDef scene = scenes::wall(30, 30);
        scene.contact.method = method;
        expect_same_with_changing_threads(scene, method == Method::force ? 300 : 200);
    }
}

/// Steps that vary, blocks that are left out.
TEST(ChangingThreads, GiveTheSameFallOfLooseBlocks)
{
    CaseDef scene = scenes::joints(30.0, 30.0, 1.0, 3.0);
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {15.0, 15.0}, .diameter = 6.0}};
    scene.stages = {{.name = "dig", .until_converged = true, .max_cycles = 100'000, .excavate = {"tunnel"}}};
    scene.convergence.loose_distance = 1e-4;
    expect_same_with_changing_threads(scene, 1500);
}

INSTANTIATE_TEST_SUITE_P(Counts, Threads, testing::Values(2, 3, 4, 8));

/// Forces that are summed as they are found, by several threads, and by lists: also where blocks are left out and wake again.
TEST(SumsAsFound, GiveTheBitsOfSumsByLists)
{
    CaseDef rock = scenes::joints(12.0, 12.0, 1.0, 3.0);
    rock.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {6.0, 6.0}, .diameter = 4.0}};
    rock.stages = {{.name = "dig", .until_converged = true, .max_cycles = 100'000, .excavate = {"tunnel"}}};
    CaseDef rubble = scenes::turned(scenes::pile(30, 5), 23.0);
    rubble.contact.method = Method::impulse;
    for (const CaseDef& scene : {rock, rubble})
    {
        const CaseRun start(scene);
        int at_rest = 0;
        State by_lists = start.state();
        std::vector<State> as_found(3, by_lists);
        CycleRunner lists(resolve_rules, std::numeric_limits<Index>::max());
        std::array<CycleRunner, 3> sums{CycleRunner(resolve_rules, 0), CycleRunner(resolve_rules, 0),
                                        CycleRunner(resolve_rules, 0)};
        for (int piece = 0; piece < 60; ++piece)
        {
            ASSERT_EQ(lists.run(start.model(), by_lists, 100, 1), no_index);
            for (int threads = 1; threads <= 3; ++threads)
            {
                ASSERT_EQ(sums[threads - 1].run(start.model(), as_found[threads - 1], 100, threads), no_index);
                ASSERT_EQ(state_hash(start.model(), as_found[threads - 1]), state_hash(start.model(), by_lists))
                    << "cycle " << by_lists.cycle << ", " << threads << " threads";
            }
            at_rest += static_cast<int>(std::ranges::count(by_lists.blocks.rest, left_out));
        }
        EXPECT_EQ(at_rest > 100, scene.contact.method != Method::impulse) << at_rest;
    }
}
}  // namespace
}  // namespace hdem
