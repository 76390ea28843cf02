#include "core/support/bolt_forces.h"
#include "core/support/bolt_link.h"
#include "core/support/bolt_pattern.h"
#include "io/case_reader.h"
#include "io/frame_writer.h"
#include "io/hdf5_reader.h"
#include "parallel/stages.h"
#include "parallel/strength_trial.h"
#include "verification/unit/case_run.h"
#include "verification/unit/small_run.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <numbers>

namespace hdem
{
namespace
{
using namespace test;

/// Two free blocks that fly apart and turn, held by one bolt; no gravity, no damping.
CaseDef flying_pair(const BoltDef& bolt)
{
    CaseDef scene = scenes::empty_scene();
    scene.blocks = {
        {.name = "left", .polygon = {{-1, 0}, {0, 0}, {0, 1}, {-1, 1}}, .velocity = {-0.5, 0.1}, .angular_velocity = 0.3},
        {.name = "right", .polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, .velocity = {0.5, -0.2}}};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.damping.preset = DampingPreset::dynamic;
    scene.bolts = {bolt};
    scene.stages = {{.name = "fly", .cycles = 2000}};
    return scene;
}

BoltDef bolt_of(BoltKind kind)
{
    BoltDef bolt{.name = "bolt", .kind = kind, .from = Vec2(-0.8, 0.3), .to = Vec2(0.7, 0.6)};
    if (kind != BoltKind::local)
        bolt.area = 1e-4;
    bolt.bond_stiffness = 1e7;
    bolt.bond_strength = 1e4;
    bolt.active_length = 0.05;
    if (kind == BoltKind::local)
        bolt.stiffness = 1e6;
    bolt.shear_stiffness = 1e6;
    bolt.yield = 8e3;
    return bolt;
}

TEST(Bolts, KeepMomentumAndTheEnergyLedger)
{
    for (const BoltKind kind : {BoltKind::anchored, BoltKind::grouted, BoltKind::local})
    {
        CaseRun run(flying_pair(bolt_of(kind)));
        run.simulation.begin_stage(0);
        const Momentum before = momentum(run.model(), run.state().blocks);
        run.advance(2000);
        const Momentum after = momentum(run.model(), run.state().blocks);
        const BoltRecord& bolt = run.state().support.bolts[0];
        EXPECT_GT(bolt.greatest_force, 1e3);
        EXPECT_LT((after.linear - before.linear).norm(), 1e-8);
        EXPECT_NEAR(after.angular, before.angular, 1e-3 * std::abs(before.angular) + 1.0);
        EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-6);
        EXPECT_NEAR(-run.state().ledger.support, bolt.stored + bolt.spent, 0.02 * (bolt.stored + bolt.spent));
    }
}

/// Let go between two walls that do not press it: impulses leave the block no damping of its own.
/// A block in a slot that is as wide as it is hangs on a bolt.
CaseDef block_in_slot(double angle_deg)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "left", scenes::rectangle({-1, -1}, {0, 2}));
    scenes::add_fixed_block(scene, "right", scenes::rectangle({1, -1}, {2, 2}));
    scenes::add_fixed_block(scene, "roof", scenes::rectangle({0, 3}, {1, 4}));
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
    scene = scenes::turned(scene, angle_deg);
    const Eigen::Rotation2D<double> turn(angle_deg * std::numbers::pi / 180.0);
    scene.bolts = {{.name = "bolt", .kind = BoltKind::anchored, .from = turn * Vec2(0.5, 3.5), .to = turn * Vec2(0.5, 0.5)}};
    scene.bolts[0].area = 1e-4;
    return scene;
}

/// It touches the walls, which do not bear it: the bolt alone holds it, and damps it.
TEST(Bolts, SwingsOfABlockThatTouchesWallsDieAway)
{
    for (const double angle : {0.0, 23.0})
    {
        CaseDef scene = block_in_slot(angle);
        scene.contact.method = Method::force;
        CaseRun run(scene);
        run.advance(20'000);
        EXPECT_LT(kinetic_energy(run.model(), run.state().blocks, run.slot("block")), 1e-6) << angle;
        EXPECT_GT(run.state().ledger.local_damping, 10.0);
    }
}

TEST(Bolts, SwingsOfABlockByImpulsesDieAway)
{
    for (const double angle : {0.0, 23.0})
    {
        CaseDef scene = block_in_slot(angle);
        scene.contact.method = Method::impulse;
        scene.stages = {{.name = "hang", .until_converged = true, .max_cycles = 300'000}};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
        const std::vector<StageResult> results = run_stages(simulation, {});
        EXPECT_TRUE(results[0].at_rest) << angle;
        const double weight = 2700.0 * 9.81;
        EXPECT_NEAR(simulation.state().support.bolts[0].force, weight, 1e-3 * weight);
        const EnergyLedger& ledger = simulation.state().ledger;
        EXPECT_GT(ledger.local_damping, 0.0);
        EXPECT_LT(std::abs(relative_residual(ledger, stored_energy(simulation.model(), simulation.state()))), 1e-6);
    }
}

/// A block slides on a floor, away from where a bolt holds it: m v^2 / 2 = mu m g s + K s^2 / 2. Friction keeps it there.
TEST(Bolts, StopABlockThatSlidesWhereItsEnergyIsSpent)
{
    constexpr double speed = 1.0, stiffness = 1e4, mass = 2700.0;
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = Method::force;
    scene.joints[0].friction_angle_deg = 10.0;
    scenes::add_fixed_block(scene, "floor", scenes::rectangle({-20, -1}, {20, 0}));
    scenes::add_fixed_block(scene, "anchor", scenes::rectangle({-5, 0}, {-4, 1}));
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {2, 0.5})).velocity = {speed, 0.0};
    scene.bolts = {{.name = "bolt", .kind = BoltKind::anchored, .from = Vec2(1.0, 0.25), .to = Vec2(-4.5, 0.25)}};
    scene.bolts[0].stiffness = stiffness;
    const double friction = std::tan(10.0 * std::numbers::pi / 180.0) * mass * 9.81;
    const double way = (std::sqrt(friction * friction + stiffness * mass * speed * speed) - friction) / stiffness;
    for (const bool seeks_rest : {false, true})
    {
        scene.stages = {{.name = "slide", .cycles = 20'000}};
        if (seeks_rest)
            scene.stages = {{.name = "slide", .cycles = {}, .until_converged = true, .max_cycles = 20'000}};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
        run_stages(simulation, {});
        const Index block = simulation.model().find_block("block");
        EXPECT_NEAR(simulation.state().blocks.displacement(block).x(), way, 0.005 * way) << seeks_rest;
    }
}

/// Grout that never slips: an error of the bolt's force would let the block swing for ever.
TEST(Bolts, AreAtRestHoweverStrongTheirBond)
{
    for (const double strength : {1e5, 1e12})
    {
        CaseDef scene = block_in_slot(0.0);
        scene.contact.method = Method::force;
        scene.blocks[2].polygon = scenes::rectangle({0, 1}, {1, 4});
        scene.bolts[0].kind = BoltKind::grouted;
        scene.bolts[0].free_length.reset();
        scene.bolts[0].stiffness.reset();
        scene.bolts[0].area = 4.4e-4;
        scene.bolts[0].bond_stiffness = 1.4e9;
        scene.bolts[0].bond_strength = strength;
        scene.bolts[0].segment = 0.0124;
        scene.stages = {{.name = "hang", .until_converged = true, .max_cycles = 100'000}};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
        EXPECT_TRUE(run_stages(simulation, {})[0].at_rest) << strength;
        const double weight = 2700.0 * 9.81;
        EXPECT_NEAR(simulation.state().support.bolts[0].force, weight, 1e-3 * weight) << strength;
    }
}

TEST(Bolts, HaveNoForceWhenInstalledButTheirPretension)
{
    CaseDef scene = flying_pair(bolt_of(BoltKind::anchored));
    scene.stages = {{.name = "fly", .cycles = 200}, {.name = "hold", .cycles = 10}};
    scene.bolts[0].stage = "hold";
    scene.bolts[0].pretension = 500.0;
    scene.bolts[0].spacing = 2.0;
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(200);
    EXPECT_EQ(run.state().support.bolts[0].status, BoltStatus::planned);
    EXPECT_EQ(run.state().ledger.support, 0.0);
    run.simulation.begin_stage(1);
    EXPECT_DOUBLE_EQ(run.state().support.bolts[0].force, 250.0);
    State state = run.state();
    std::vector<BlockPush> pushes;
    pull_bolts(run.model(), state, 0.0, pushes);
    EXPECT_NEAR(state.support.bolts[0].force, 250.0, 1e-6);
    ASSERT_EQ(pushes.size(), 2u);
    EXPECT_NEAR(std::hypot(pushes[0].force.x, pushes[0].force.y), 250.0, 1e-6);
}

TEST(Bolts, AreLostWithABlock)
{
    for (const BoltKind kind : {BoltKind::anchored, BoltKind::grouted, BoltKind::local})
    {
        CaseDef scene = flying_pair(bolt_of(kind));
        scene.stages = {{.name = "fly", .cycles = 50}, {.name = "hold", .cycles = 10, .excavate = {"right"}}};
        CaseRun run(scene);
        run.simulation.begin_stage(0);
        run.advance(50);
        run.simulation.begin_stage(1);
        run.advance(1);
        EXPECT_EQ(run.state().support.bolts[0].status, BoltStatus::lost);
        const Momentum before = momentum(run.model(), run.state().blocks);
        run.advance(9);
        EXPECT_EQ((momentum(run.model(), run.state().blocks).linear - before.linear).norm(), 0.0);
    }
}

TEST(Bolts, AreInTheFrameOnceInstalled)
{
    const ScratchFolder folder("bolt_frame");
    BoltDef near = bolt_of(BoltKind::anchored), late = bolt_of(BoltKind::local);
    near.spacing = 2.0;
    late.name = "late";
    late.stage = "more";
    CaseDef scene = flying_pair(near);
    scene.bolts.push_back(late);
    scene.stages.push_back({.name = "more", .cycles = 10});
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(500);
    write_bolt_frame(folder / "bolts_000000.hdf", run.model(), run.state());
    const Hdf5Reader in(folder / "bolts_000000.hdf");
    EXPECT_THAT(in.read_texts("/hdem/bolt_names"), testing::ElementsAre("bolt", "late"));
    EXPECT_THAT(in.read<std::int32_t>("/VTKHDF/CellData/bolt", {any_extent}), testing::ElementsAre(0));
    EXPECT_THAT(in.read<std::uint8_t>("/VTKHDF/CellData/status", {1}), testing::ElementsAre(3));
    EXPECT_FLOAT_EQ(in.read<float>("/VTKHDF/CellData/axial_force", {1}).front(), 8e3F) << "of one bolt: its yield";
    const auto points = in.read<double>("/VTKHDF/Points", {2, 3});
    const Blocks& blocks = run.state().blocks;
    const Vec2 head = run.model().origin + Vec2(blocks.motion[0].x, blocks.motion[0].y) +
                      turned_with(blocks.motion[0], Vec2(-0.3, -0.2));
    EXPECT_NEAR(points[0], head.x(), 1e-12);
    EXPECT_NEAR(points[1], head.y(), 1e-12);
    run.simulation.begin_stage(1);
    run.advance(1);
    write_bolt_frame(folder / "bolts_000001.hdf", run.model(), run.state());
    EXPECT_THAT(Hdf5Reader(folder / "bolts_000001.hdf").read<std::int32_t>("/VTKHDF/CellData/bolt", {any_extent}),
                testing::ElementsAre(0, 1));
}

/// A slab that has slipped until its dowel holds it.
TEST(Bolts, KeepTheirForcesInTrialsOfStrength)
{
    CaseRun run(read_case_text(R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = 10.0
[gravity]
tilt_deg = 20.0
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[-6, -1], [10, -1], [10, 0], [-6, 0]]
fixed = true
[[block]]
name = "slab"
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[bolt]]
kind = "local"
from = [2.0, 0.5]
to = [2.0, -0.9]
stiffness = 0.0
shear_stiffness = 1e7
shear_strength = 5e4
active_length = 0.05
[[stage]]
until = "converged"
)",
                               "case.toml")
                    .def);
    run.simulation.begin_stage(0);
    run.advance(20000);
    const double slip = run.state().blocks.displacement(1).norm();
    ASSERT_GT(slip, 1e-3);
    const Moment rest = elastic_state({run.model(), run.state()}, 1);
    const auto trial_of = [&](bool bolts, double factor)
    { return run_trial(rest, {.reduction = {.factor = factor, .joints = {}, .bolts = bolts}, .failure = {}}, 1); };
    const Trial same = trial_of(false, 1.0);
    EXPECT_EQ(same.end, TrialEnd::stable);
    EXPECT_LT(same.displacement, 0.1 * slip) << "the dowel is not installed once more";
    EXPECT_EQ(trial_of(false, 3.0).end, TrialEnd::stable);
    EXPECT_EQ(trial_of(true, 3.0).end, TrialEnd::failed) << "with a third of its strength it does not hold the slab";
}

TEST(Bolts, AlongAJointAreWarnedOf)
{
    for (const auto& [x, is_told] : {std::pair(1.0, true), std::pair(1.01, false)})
    {
        CaseDef scene = scenes::grid(2, 2);
        BoltDef bolt;
        bolt.name = "b";
        bolt.kind = BoltKind::anchored;
        bolt.from = Vec2(x, 0.5);
        bolt.to = Vec2(x, 1.5);
        bolt.stiffness = 1e7;
        scene.bolts.push_back(bolt);
        const std::vector<Problem> warnings = build_model(scene).warnings;
        ASSERT_EQ(warnings.size(), is_told ? 1u : 0u) << x;
        for (const Problem& warning : warnings)
            EXPECT_NE(warning.text.find("it runs along the joint between blocks \"1."), std::string::npos) << warning.text;
    }
}

TEST(BoltPattern, HalvesTheAngleInACorner)
{
    const Polygon room = {{0, 0}, {4, 0}, {4, 2}, {2, 3}, {0, 2}};
    BoltDef pattern;
    pattern.length = 3.0;
    pattern.along = 1.5;
    pattern.arc = Vec2(30.0, 150.0);
    const std::vector<BoltLine> roof = bolts_around(room, pattern);
    ASSERT_EQ(roof.size(), 3u);
    EXPECT_LT((roof[1].from - Vec2(2.0, 3.0)).norm(), 1e-12);
    EXPECT_LT((roof[1].to - Vec2(2.0, 6.0)).norm(), 1e-12);
    EXPECT_NEAR(roof[0].to.x() + roof[2].to.x(), 4.0, 1e-12);
}

TEST(BoltPattern, StandsInEqualStretchesSquareToTheOutline)
{
    const Polygon room = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};
    BoltDef pattern;
    pattern.length = 3.0;
    pattern.along = 1.5;
    pattern.arc = Vec2(20.0, 160.0);  // the roof: its corners lie at 26.6 and 153.4 degrees
    const std::vector<BoltLine> roof = bolts_around(room, pattern);
    const double wall = 1.0 - 2.0 * std::tan(radians(20.0)), length = 4.0 + 2.0 * wall;
    ASSERT_EQ(roof.size(), 4u);
    for (std::size_t i = 0; i < roof.size(); ++i)
    {
        EXPECT_NEAR(roof[i].from.y(), 2.0, 1e-12);
        EXPECT_NEAR(roof[i].from.x(), 4.0 + wall - (static_cast<double>(i) + 0.5) * length / 4.0, 1e-12);
        EXPECT_LT((roof[i].to - roof[i].from - Vec2(0.0, 3.0)).norm(), 1e-12);
    }
    pattern.arc.reset();
    const std::vector<BoltLine> all = bolts_around({room.rbegin(), room.rend()}, pattern);
    EXPECT_EQ(all.size(), 8u);
    for (const BoltLine& line : all)
        EXPECT_GT((line.to - Vec2(2.0, 1.0)).norm(), (line.from - Vec2(2.0, 1.0)).norm());
}
}  // namespace
}  // namespace hdem
