#include "core/state/contact_order.h"
#include "io/checkpoint.h"
#include "verification/scenes/sample_joints.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/io/broken_runs.h"
#include "verification/unit/small_run.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hdem
{
namespace
{
using runs::restart, runs::run_until, runs::run_unbroken, runs::RunEnd;
using test::expect_to_go_on;
using test::ScratchFolder;
using test::tunnel;

TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfStressedRock)
{
    const ScratchFolder folder("checkpoint_stress");
    CaseDef scene = tunnel(Method::hybrid);
    scene.insitu = {.given = true, .surface = 12.0, .ratio = 1.5};
    const RunEnd unbroken = run_unbroken(scene);
    expect_to_go_on(scene, folder.path(), unbroken, {50, 310, 1150}, {1, 3});
}

TEST(CheckpointOfFeatures, GivesTheUnbrokenRunBelowWater)
{
    const ScratchFolder folder("checkpoint_water");
    CaseDef scene = tunnel(Method::hybrid);
    scene.water = {.given = true, .table = {{0.0, 14.0}, {12.0, 6.0}}};
    scene.stages[1].water_level = 5.0;
    scene.stages[1].relax_cycles = 300;
    const RunEnd unbroken = run_unbroken(scene);
    expect_to_go_on(scene, folder.path(), unbroken, {310, 499, 500, 501, 1150}, {1, 2, 3});
}

/// Bolts of all kinds and a lining around the tunnel; some yield, slip, part and rupture.
TEST(CheckpointOfFeatures, GivesTheUnbrokenRunWithBolts)
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
    LinerDef beyond = liner;  // it begins where there is no block
    beyond.name = "beyond";
    beyond.around.clear();
    beyond.path = {{-2.0, 12.0}, {3.0, 12.0}};
    scene.liners.push_back(beyond);
    const RunEnd unbroken = run_unbroken(scene);
    expect_to_go_on(scene, folder.path(), unbroken, {310, 700, 1150}, {1, 2, 3});
}

/// Walls that begin, end and move, tractions and freed blocks: what acts follows from the number of the stage.
TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfSides)
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
    expect_to_go_on(scene, folder.path(), unbroken, {150, 300, 301, 433, 700, 701, 855}, {1, 2, 3});
}

TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfEachJointLaw)
{
    for (const JointDef& joint : scenes::sample_joints())
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
TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfTwoJointLaws)
{
    const ScratchFolder folder("checkpoint_two_laws");
    CaseDef scene = tunnel(Method::hybrid);
    scene.insitu = {.given = true, .surface = 12.0, .ratio = 1.5};
    scene.joints = {scenes::sample_joints()[0], scenes::sample_joints()[1]};
    scene.joints[1].name = "rough";
    scene.joint_sets[0].joint = "rough";
    const RunEnd unbroken = run_unbroken(scene);
    expect_to_go_on(scene, folder.path(), unbroken, {310, 1150}, {1, 2, 3, 8});
    hdem::Setup setup = build_model(scene);
    const State state = CheckpointReader(checkpoint_file(folder.path())).state(setup.model);
    EXPECT_FALSE(std::ranges::is_sorted(order_by_parts(state.contacts)));
}

/// Contacts go on with their forces where a stage sets another stiffness: what they keep for that is in checkpoints before and after.
TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfAStiffnessThatAStageSets)
{
    const ScratchFolder folder("checkpoint_stiffness");
    CaseDef scene = tunnel(Method::hybrid);
    scene.stages[1].joints = scene.joints;
    scene.stages[1].joints[0].normal_stiffness *= 2.0;
    const RunEnd unbroken = run_unbroken(scene);
    const std::int64_t begin = unbroken.stage_cycles[0];
    expect_to_go_on(scene, folder.path(), unbroken, {begin - 50, begin, begin + 1, begin + 310}, {1, 3});
}

TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfStepsThatVary)
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

TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfForcesThatAreTakenOff)
{
    const ScratchFolder folder("checkpoint_relax");
    CaseDef scene = tunnel(Method::hybrid);
    scene.stages[1].relax_cycles = 600;
    const RunEnd unbroken = run_unbroken(scene);
    const std::int64_t begin = unbroken.stage_cycles[1];
    expect_to_go_on(scene, folder.path(), unbroken, {begin + 1, begin + 311, begin + 600}, {1, 3});
}

TEST(CheckpointOfFeatures, GivesTheUnbrokenRunOfBlocksThatRest)
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
}  // namespace
}  // namespace hdem
