#include "core/model/block_order.h"
#include "core/rock/build_model.h"
#include "core/state/contact_order.h"
#include "core/state/state_hash.h"
#include "io/checkpoint.h"
#include "io/stage_end_text.h"
#include "verification/runs/run_end.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/sample_joints.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <random>

namespace hdem
{
namespace
{
using runs::restart, runs::run_until, runs::run_unbroken, runs::RunEnd;
using test::ScratchFolder;

/// A tunnel in rock: blocks fall out after the excavation; the last stage changes method and damping.
CaseDef tunnel(Method method)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.0, 3.0);
    scene.contact.method = method;
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {6.0, 6.0}, .diameter = 4.0}};
    scene.stages = {{.name = "gravity", .until_converged = true, .max_cycles = 300},
                    {.name = "dig", .cycles = 900, .excavate = {"tunnel"}},
                    {.name = "other", .cycles = 200, .method = Method::hybrid, .damping = DampingPreset::dynamic}};
    scene.convergence.least_cycles = 100;
    scene.convergence.mean_speed = 1.0;
    return scene;
}

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
    for (const std::int64_t cycle : cycles)
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
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
    for (const std::int64_t cycle : cycles)
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 2, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

TEST(Checkpoint, GivesTheUnbrokenRunOfStressedRock)
{
    const ScratchFolder folder("checkpoint_stress");
    CaseDef scene = tunnel(Method::hybrid);
    scene.insitu = {.given = true, .surface = 12.0, .ratio = 1.5};
    const RunEnd unbroken = run_unbroken(scene);
    for (const std::int64_t cycle : {50, 310, 1150})
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

TEST(Checkpoint, GivesTheUnbrokenRunBelowWater)
{
    const ScratchFolder folder("checkpoint_water");
    CaseDef scene = tunnel(Method::hybrid);
    scene.water = {.given = true, .table = {{0.0, 14.0}, {12.0, 6.0}}};
    scene.stages[1].water_level = 5.0;
    scene.stages[1].relax_cycles = 300;
    const RunEnd unbroken = run_unbroken(scene);
    for (const std::int64_t cycle : {310, 499, 500, 501, 1150})
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 2, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

/// Bolts of all kinds and a lining around the tunnel; some yield, slip, part and rupture.
TEST(Checkpoint, GivesTheUnbrokenRunWithBolts)
{
    const ScratchFolder folder("checkpoint_bolts");
    CaseDef scene = tunnel(Method::force);
    const BoltDef around{.around = "tunnel", .length = 3.0, .along = 1.5, .stage = "dig", .spacing = 1.5};
    for (const BoltKind kind : {BoltKind::anchored, BoltKind::grouted, BoltKind::local})
    {
        BoltDef& bolt = scene.bolts.emplace_back(around);
        bolt.name = "bolt" + std::to_string(scene.bolts.size());
        bolt.kind = kind;
    }
    scene.bolts[0].area = scene.bolts[1].area = 2e-4;
    scene.bolts[0].pretension = 2e4;
    scene.bolts[0].yield = 2.1e4;
    scene.bolts[1].bond_stiffness = 1e7;
    scene.bolts[1].bond_strength = 2e3;
    scene.bolts[2].stiffness = scene.bolts[2].shear_stiffness = 1e7;
    scene.bolts[2].shear_strength = 1e3;
    scene.bolts[2].rupture_strain = 0.1;
    scene.bolts[2].active_length = 0.05;
    LinerDef& liner = scene.liners.emplace_back();
    liner.name = "shotcrete";
    liner.around = "tunnel";
    liner.stage = "dig";
    liner.thickness = 0.1;
    liner.modulus = 1e10;
    liner.moment_strength = 500.0;
    liner.normal_stiffness = 1e9;
    liner.bond_strength = 1e3;
    liner.cohesion = 1e3;
    liner.hardening = {{{0.0, 0.1}, {500.0, 1.0}}};
    const RunEnd unbroken = run_unbroken(scene);
    for (const std::int64_t cycle : {310, 700, 1150})
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 2, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

/// Walls that begin, end and move, tractions and freed blocks: what acts follows from the number of the stage.
TEST(Checkpoint, GivesTheUnbrokenRunOfSides)
{
    const ScratchFolder folder("checkpoint_sides");
    CaseDef scene = scenes::joints(16.0, 16.0, 1.0, 3.0);
    scene.contact.method = Method::hybrid;
    scene.domain.fixed = {"bottom"};
    scene.insitu = {.given = true, .surface = 40.0, .ratio = 0.7};
    const auto add = [&](const char* side, BoundaryKind kind, const std::vector<std::string>& stages)
    {
        BoundaryDef& boundary = scene.boundaries.emplace_back();
        boundary.name = side + std::to_string(scene.boundaries.size());
        boundary.side = side;
        boundary.kind = kind;
        boundary.stages = stages;
        return &boundary;
    };
    add("left", BoundaryKind::roller, {});
    add("right", BoundaryKind::fixed, {"held"});
    add("right", BoundaryKind::stress, {"loose"})->stress = Vec2(0.4e6, 0.0);
    add("right", BoundaryKind::velocity, {"pushed"})->velocity = {-0.01, 0.0};
    add("top", BoundaryKind::stress, {"held", "loose"})->is_insitu = true;
    BoundaryDef* servo = add("top", BoundaryKind::servo, {"pushed"});
    servo->target = 1e6;
    servo->max_velocity = 0.05;
    scene.stages = {{.name = "held", .cycles = 300},
                    {.name = "loose", .until_converged = true, .max_cycles = 400, .relax_cycles = 200},
                    {.name = "pushed", .cycles = 300}};
    const RunEnd unbroken = run_unbroken(scene);
    EXPECT_EQ(unbroken.cycle, 1000);
    for (const std::int64_t cycle : {150, 300, 301, 433, 700, 701, 855})
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 2, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

TEST(Checkpoint, GivesTheUnbrokenRunOfEachJointLaw)
{
    for (const JointDef& joint : test::sample_joints())
    {
        const ScratchFolder folder("checkpoint_laws");
        CaseDef scene = tunnel(Method::hybrid);
        scene.insitu = {.given = true, .surface = 12.0, .ratio = 1.5};
        scene.joints = {joint};
        const RunEnd unbroken = run_unbroken(scene);
        run_until(scene, 310, folder.path());
        for (const int threads : {1, 2, 3, 8})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken)
                << "law " << static_cast<int>(joint.law) << ", threads " << threads;
    }
}

/// Contacts of one law stand together: the list is not in the order of the parts, and its order goes into the checkpoint.
TEST(Checkpoint, GivesTheUnbrokenRunOfTwoJointLaws)
{
    const ScratchFolder folder("checkpoint_two_laws");
    CaseDef scene = tunnel(Method::hybrid);
    scene.insitu = {.given = true, .surface = 12.0, .ratio = 1.5};
    scene.joints = {test::sample_joints()[0], test::sample_joints()[1]};
    scene.joints[1].name = "rough";
    scene.joint_sets[0].joint = "rough";
    const RunEnd unbroken = run_unbroken(scene);
    for (const std::int64_t cycle : {310, 1150})
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 2, 3, 8})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
    hdem::Setup setup = build_model(scene);
    const State state = CheckpointReader(checkpoint_file(folder.path())).state(setup.model);
    EXPECT_FALSE(std::ranges::is_sorted(order_by_parts(state.contacts)));
}

TEST(Checkpoint, GivesTheUnbrokenRunOfStepsThatVary)
{
    const ScratchFolder folder("checkpoint_step");
    CaseDef scene = tunnel(Method::hybrid);
    scene.stages = {{.name = "dig", .until_converged = true, .max_cycles = 1500, .excavate = {"tunnel"}}};
    scene.convergence.mean_speed = 1e-9;
    scene.convergence.loose_distance = 1e-4;
    const RunEnd unbroken = run_unbroken(scene);
    for (const std::int64_t cycle : {601, 1203})
    {
        run_until(scene, cycle, folder.path());
        EXPECT_EQ(restart(scene, folder.path(), 2), unbroken) << "cycle " << cycle;
    }
    hdem::Setup setup = build_model(scene);
    const State state = CheckpointReader(checkpoint_file(folder.path())).state(setup.model);
    EXPECT_NE(state.blocks.step.next, setup.model.time_step);
}

TEST(Checkpoint, GivesTheUnbrokenRunOfForcesThatAreTakenOff)
{
    const ScratchFolder folder("checkpoint_relax");
    CaseDef scene = tunnel(Method::hybrid);
    scene.stages[1].relax_cycles = 600;
    const RunEnd unbroken = run_unbroken(scene);
    const std::int64_t begin = unbroken.stage_cycles[1];
    for (const std::int64_t cycle : {begin + 1, begin + 311, begin + 600})
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

TEST(Checkpoint, GivesTheUnbrokenRunOfBlocksThatRest)
{
    const ScratchFolder folder("checkpoint_rest");
    CaseDef scene = tunnel(Method::hybrid);
    scene.stages = {{.name = "dig", .until_converged = true, .max_cycles = 9000, .excavate = {"tunnel"}}};
    scene.convergence.least_cycles = 10000;
    scene.convergence.block_unbalanced_ratio = 1e-2;
    scene.convergence.unbalanced_force_ratio = 1e-2;
    const RunEnd unbroken = run_unbroken(scene);
    for (const std::int64_t cycle : {3000, 6703, 8601})
    {
        run_until(scene, cycle, folder.path());
        EXPECT_EQ(restart(scene, folder.path(), 2), unbroken) << "cycle " << cycle;
    }
    hdem::Setup setup = build_model(scene);
    const State state = CheckpointReader(checkpoint_file(folder.path())).state(setup.model);
    EXPECT_GT(std::count(state.blocks.rest.begin(), state.blocks.rest.end(), left_out), 5);
    EXPECT_NE(state.blocks.step.next, setup.model.time_step);
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
    for (const std::int64_t cycle : {unbroken.stage_cycles[1] + 1, unbroken.cycle - 50})
    {
        run_until(scene, cycle, folder.path());
        for (const int threads : {1, 3})
            EXPECT_EQ(restart(scene, folder.path(), threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
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
