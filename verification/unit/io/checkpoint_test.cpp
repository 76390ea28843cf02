#include "core/model/block_order.h"
#include "core/rock/build_model.h"
#include "core/state/state_hash.h"
#include "io/checkpoint.h"
#include "io/stage_end_text.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/io/broken_runs.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <random>

namespace hdem
{
namespace
{
using runs::restart, runs::run_until, runs::run_unbroken, runs::RunEnd;
using test::expect_to_go_on;
using test::ScratchFolder;
using test::tunnel;

class Checkpoint : public testing::TestWithParam<Method>
{
};

TEST_P(Checkpoint, GivesTheUnbrokenRunToTheLastBitFromAnyCycle)
{
    const ScratchFolder folder("checkpoint");
    const CaseDef scene = tunnel(GetParam());
    const RunEnd unbroken = run_unbroken(scene);
    EXPECT_GT(unbroken.cycle, 1100);
    std::mt19937 random(1);
    std::vector<std::int64_t> cycles = {1, unbroken.stage_cycles[1], unbroken.stage_cycles[1] + 1, unbroken.cycle};
    while (cycles.size() < 9)
        cycles.push_back(std::uniform_int_distribution<std::int64_t>(1, unbroken.cycle)(random));
    expect_to_go_on(scene, folder.path(), unbroken, cycles, {1, 3});
}

TEST(Checkpoint, EndsStagesInTheSameCycle)
{
    const ScratchFolder folder("checkpoint_ends");
    CaseDef scene = tunnel(Method::hybrid);
    scene.histories = {{.name = "pair", .between = {"b20", "b21"}, .quantities = {"shear_displacement"}}};
    const auto end = [](const char* text) { return read_stage_end(text).end; };
    scene.convergence.mean_speed = 1e-2;
    scene.loads = {{.blocks = {"*"}, .force = {1.0, 0.0}, .factor = {.ramp_cycles = Vec2(0.0, 350.0)}}};
    scene.stages = {{.name = "quiet", .ends = {end("quiet for 150 cycles"), end("displacement > 5")}, .max_cycles = 4000},
                    {.name = "dig", .ends = {end("displacement > 1e-3 for 30 cycles")}, .max_cycles = 4000, .excavate = {"tunnel"}},
                    {.name = "band",
                     .ends = {end("history:pair.shear_displacement within 1e-3 for 120 cycles"), end("time > 100")},
                     .max_cycles = 4000}};
    const RunEnd unbroken = run_unbroken(scene);
    ASSERT_EQ(unbroken.stage_cycles.size(), 9u);
    EXPECT_GT(unbroken.stage_cycles[1], 500) << "350 cycles of the ramp and 150 of quiet";
    EXPECT_LT(unbroken.stage_cycles[1], 4000);
    EXPECT_LT(unbroken.stage_cycles[4], 4000);
    EXPECT_LT(unbroken.stage_cycles[7], 4000);
    std::mt19937 random(1);
    std::vector<std::int64_t> cycles = {unbroken.stage_cycles[1] - 10, unbroken.stage_cycles[1], unbroken.cycle - 20};
    while (cycles.size() < 15)
        cycles.push_back(std::uniform_int_distribution<std::int64_t>(1, unbroken.cycle)(random) / 5 * 5);
    expect_to_go_on(scene, folder.path(), unbroken, cycles, {1, 2, 3});
}

/// What a summary says of stages that were over before the restart, and of the one that runs.
TEST(Checkpoint, KeepsWhichBlocksWereNotAtRestAndWhatStaticSolutionsFound)
{
    const ScratchFolder folder("checkpoint_told");
    CaseDef scene = scenes::joints(16.0, 16.0, 0.8, 2.0);
    scene.contact.method = Method::force;
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {8.0, 8.0}, .diameter = 6.0}};
    scene.stages = {
        {.name = "rest", .until_converged = true, .max_cycles = 400, .solver = RestSolver::statics},
        {.name = "dig", .until_converged = true, .max_cycles = 600, .solver = RestSolver::statics, .excavate = {"tunnel"}},
        {.name = "more", .cycles = 100}};
    scene.convergence.least_cycles = 100;
    const RunEnd unbroken = run_unbroken(scene);
    using testing::HasSubstr, testing::Contains;
    EXPECT_THAT(unbroken.told, Contains(HasSubstr("balanced after")).Times(testing::Ge(2)));
    EXPECT_THAT(unbroken.told, Contains(HasSubstr("loose: b")));
    EXPECT_THAT(unbroken.told, Contains(testing::ContainsRegex("not at rest: [0-9]")));
    expect_to_go_on(scene, folder.path(), unbroken, {unbroken.stage_cycles[1] + 1, unbroken.cycle - 50}, {1, 3});
}

/// Blocks may be sorted anew while a run goes on; the case alone gives the order at the start.
TEST(CheckpointReader, BringsTheModelIntoTheOrderOfTheRun)
{
    const ScratchFolder folder("order");
    const CaseDef scene = tunnel(Method::hybrid);
    run_until(scene, 700, folder.path());
    hdem::Setup setup = build_model(scene);
    const std::vector<Index> in_the_run = setup.model.user_number;
    std::vector<Index> other = in_the_run;
    std::shuffle(other.begin(), other.end(), std::mt19937(5));
    const std::uint64_t hash = model_hash(setup.model);
    reorder_blocks(other, setup.model);
    ASSERT_NE(setup.model.user_number, in_the_run);
    EXPECT_EQ(model_hash(setup.model), hash);

    State state = CheckpointReader(checkpoint_file(folder.path())).state(setup.model);
    EXPECT_EQ(setup.model.user_number, in_the_run);
    Simulation simulation(std::move(setup.model), std::move(state));
    EXPECT_EQ(runs::run_to_end(simulation), run_unbroken(scene));
}

INSTANTIATE_TEST_SUITE_P(Methods, Checkpoint, testing::Values(Method::force, Method::impulse, Method::hybrid));
}  // namespace
}  // namespace hdem
