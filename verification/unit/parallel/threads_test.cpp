#include "verification/unit/case_run.h"

#include <algorithm>

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

INSTANTIATE_TEST_SUITE_P(Counts, Threads, testing::Values(2, 3, 4, 8));
}  // namespace
}  // namespace hdem
