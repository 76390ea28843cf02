#include "core/support/bolt_link.h"
#include "core/support/liner_beam.h"
#include "core/support/liner_forces.h"
#include "core/support/liner_rest.h"
#include "io/frame_writer.h"
#include "io/hdf5_reader.h"
#include "parallel/stages.h"
#include "verification/unit/case_run.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <numbers>

namespace hdem
{
namespace
{
using namespace test;

LinerDef lining()
{
    LinerDef liner{.name = "liner", .path = {{1.0, 0.0}, {-1.0, 0.0}}, .thickness = 0.05, .modulus = 1e9};
    liner.segment = 0.1;
    liner.normal_stiffness = 1e8;
    liner.bond_strength = 1e5;
    liner.cohesion = 1e5;
    return liner;
}

/// Two free blocks that move apart and turn, lined along their lower side; no gravity, no damping.
CaseDef flying_pair(const LinerDef& liner)
{
    CaseDef scene = scenes::empty_scene();
    scene.blocks = {
        {.name = "left", .polygon = {{-1, 0}, {0, 0}, {0, 1}, {-1, 1}}, .velocity = {-0.05, 0.01}, .angular_velocity = 0.03},
        {.name = "right", .polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, .velocity = {0.05, -0.02}}};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.damping.preset = DampingPreset::dynamic;
    scene.liners = {liner};
    scene.stages = {{.name = "fly", .cycles = 2000}};
    return scene;
}

TEST(Liners, KeepMomentumAndTheEnergyLedger)
{
    LinerDef light = lining();
    light.density = 1e-3;  // so that next to all momentum is that of the blocks
    CaseRun run(flying_pair(light));
    run.simulation.begin_stage(0);
    const Momentum before = momentum(run.model(), run.state().blocks);
    run.advance(2000);
    const Momentum after = momentum(run.model(), run.state().blocks);
    const LinerRecord& liner = run.state().support.liners[0];
    EXPECT_GT(run.state().support.liners[0].displacement, 1e-4);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-3);
    EXPECT_NEAR(after.angular, before.angular, 1e-3 * std::abs(before.angular) + 1.0);
    EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-6);
    EXPECT_NEAR(-run.state().ledger.support, liner.stored + liner.spent, 0.05 * (liner.stored + liner.spent));
}

TEST(Liners, HaveNoForceWhenInstalledNorWhereNoBlockIsLeft)
{
    CaseDef scene = flying_pair(lining());
    scene.liners[0].stage = "hold";
    scene.stages = {{.name = "fly", .cycles = 200},
                    {.name = "hold", .cycles = 10},
                    {.name = "dig", .cycles = 10, .excavate = {"left", "right"}}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(200);
    EXPECT_EQ(run.state().support.liners[0].installed, 0);
    EXPECT_EQ(run.state().ledger.support, 0.0);
    run.simulation.begin_stage(1);
    LinerSolvers solvers;
    State state = run.state();
    std::vector<BlockPush> pushes;
    press_liners(run.model(), state, solvers, pushes);
    EXPECT_TRUE(pushes.empty());
    run.advance(10);
    EXPECT_NE(run.state().ledger.support, 0.0);
    run.simulation.begin_stage(2);
    const double work = run.state().ledger.support;
    run.advance(10);
    EXPECT_EQ(run.state().ledger.support, work);
    State after = run.state();
    pushes.clear();
    press_liners(run.model(), after, solvers, pushes);
    EXPECT_TRUE(pushes.empty());
}

TEST(Liners, AreInTheFrameOnceInstalled)
{
    const ScratchFolder folder("liner_frame");
    CaseDef scene = flying_pair(lining());
    scene.liners[0].stage = "hold";
    scene.stages = {{.name = "fly", .cycles = 200}, {.name = "hold", .cycles = 100}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(200);
    write_liner_frame(folder / "liners_000000.hdf", run.model(), run.state());
    EXPECT_TRUE(Hdf5Reader(folder / "liners_000000.hdf").read<std::int32_t>("/VTKHDF/CellData/liner", {any_extent}).empty());
    run.simulation.begin_stage(1);
    run.advance(100);
    write_liner_frame(folder / "liners_000001.hdf", run.model(), run.state());
    const Hdf5Reader in(folder / "liners_000001.hdf");
    EXPECT_THAT(in.read_texts("/hdem/liner_names"), testing::ElementsAre("liner"));
    const auto thrust = in.read<float>("/VTKHDF/CellData/thrust", {any_extent});
    ASSERT_EQ(thrust.size(), 20U) << "2 m in segments of 0.1 m";
    EXPECT_LT(*std::ranges::min_element(thrust), -1e3F) << "the blocks pull it apart in its middle";
    const auto points = in.read<double>("/VTKHDF/Points", {40, 3});
    const Blocks& blocks = run.state().blocks;
    const Vec2 corner = run.model().origin + Vec2(blocks.motion[1].x, blocks.motion[1].y) +
                        turned_with(blocks.motion[1], Vec2(0.5, -0.5));
    EXPECT_NEAR(points[0], corner.x(), 3e-4) << "it follows the rock behind it";
    EXPECT_NEAR(points[1], corner.y(), 3e-4);
    EXPECT_GT((corner - Vec2(1.0, 0.0)).norm(), 9e-4) << "it has come far enough to tell";
}

TEST(LinerBeam, StaysWithinItsStrengthsAndGivesItsTangents)
{
    const BeamLaw law{
        .axial = 1e6, .bending = 1e3, .compressive_strength = 500.0, .tensile_strength = 100.0, .moment_strength = 10.0};
    for (const double e : {-1e-3, -1e-4, 5e-5, 2e-3})
        for (const double first : {-0.01, -1e-3, 0.0, 2e-3, 0.02})
            for (const double second : {-0.015, -2e-3, 0.0, 1e-3, 0.01})
            {
                const BeamAnswer a = answer_of_beam(law, e, {first, second});
                EXPECT_GE(a.thrust, -500.0);
                EXPECT_LE(a.thrust, 100.0);
                for (int end = 0; end < 2; ++end)
                {
                    EXPECT_LE(std::abs(a.moment[end]), 10.0 * (1.0 + 1e-12));
                    EXPECT_GE(a.moment[end] * a.turned[end], 0.0) << "flow against the moment";
                }
                // What has not flowed is elastic.
                const double p = first - a.turned[0], q = second - a.turned[1];
                EXPECT_NEAR(a.moment[0], 1e3 * (4.0 * p + 2.0 * q), 1e-9);
                EXPECT_NEAR(a.moment[1], 1e3 * (2.0 * p + 4.0 * q), 1e-9);
                const double by = 1e-9;
                const BeamAnswer next = answer_of_beam(law, e, {first, second + by});
                if (next.flows == a.flows)
                {
                    EXPECT_NEAR((next.moment[1] - a.moment[1]) / by, a.bending[2], 1.0);
                    EXPECT_NEAR((next.stored + next.spent - a.stored - a.spent) / by, a.moment[1], 1e-3)
                        << "force is the slope of the energy";
                }
            }
}

TEST(Liners, KeepTheirForcesAsTheyHarden)
{
    LinerDef fresh = lining();
    fresh.hardening = {{{0.0, 0.1}, {400.0, 0.1}, {401.0, 1.0}}};
    fresh.density = 1e-3;
    CaseDef scene = flying_pair(fresh);
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(400);
    const double before = run.state().support.liners[0].moment;
    run.advance(2);
    EXPECT_GT(before, 0.0);
    EXPECT_NEAR(run.state().support.liners[0].moment, before, 0.1 * before) << "ten times as stiff";
}
/// A lining below a roof that does not move, held by its bond alone.
CaseDef hanging(double bond_over_weight)
{
    LinerDef liner = lining();
    liner.bond_strength = bond_over_weight * liner.density * 9.81 * liner.thickness;
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "roof", scenes::rectangle({-1.0, 0.0}, {1.0, 1.0}));
    scenes::add_fixed_block(scene, "stand", scenes::rectangle({3.0, 0.0}, {5.0, 1.0}));
    scenes::add_block(scene, "stone", scenes::rectangle({3.5, 1.0}, {4.5, 2.0}));
    scene.liners = {liner};
    scene.stages = {{.name = "hang", .until_converged = true, .max_cycles = 20000}};
    return scene;
}

std::vector<StageResult> run_all(CaseRun& run)
{
    return run_stages(run.simulation, {});
}

/// Put on at once the weight would swing to twice itself.
TEST(Liners, HangByABondThatBearsTheirWeight)
{
    CaseRun holds(hanging(1.05)), falls(hanging(0.95));
    run_all(holds);
    run_all(falls);
    EXPECT_EQ(holds.state().support.liners[0].parted, 0.0);
    EXPECT_NEAR(falls.state().support.liners[0].parted, 2.0, 1e-9);
    EXPECT_LT(holds.state().support.liners[0].displacement, 1e-3);
    EXPECT_GT(falls.state().support.liners[0].displacement, 3e-2) << "when the stone is at rest";
}

/// An arc that begins at a corner leaves a piece of round-off before it.
TEST(Liners, HaveNoBeamOfRoundOff)
{
    CaseDef scene = hanging(1e3);
    scene.liners[0].path = {{1.0, 0.0}, {1.0 - 1e-14, 0.0}, {-1.0, 0.0}, {-1.0, 1e-15}};
    CaseRun run(scene);
    for (const LinerSegment& segment : run.model().support.liners[0].segments)
        EXPECT_GT(segment.length, 0.01);
    run_all(run);
    const double sag = run.model().support.liners[0].mass * 9.81 / 1e8;
    EXPECT_NEAR(run.state().support.liners[0].displacement, sag, 1e-3 * sag);
}

/// The rock behind it is one block with a notch.
TEST(Liners, HaveNoRockBehindThemAtANotch)
{
    CaseDef scene = flying_pair(lining());
    scene.blocks.resize(1);
    scene.blocks[0].polygon = {{-1, 0}, {-0.5, 0}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, 0}, {1, 0}, {1, 1}, {-1, 1}};
    const CaseRun run(scene);
    const Liner& liner = run.model().support.liners[0];
    for (const LinerSegment& segment : liner.segments)
    {
        const double middle = 0.5 * (liner.nodes[segment.node[0]] + liner.nodes[segment.node[1]]).x() + run.model().origin.x();
        EXPECT_EQ(segment.block == no_index, std::abs(middle) < 0.5) << middle;
    }
}

LinerMotion motion_of(const CaseRun& run)
{
    return rest_of_liner(run.model(), run.state(), 0).motion;
}

/// A stage that seeks rest waits for one that still hangs on the rock, not for one that falls.
TEST(Liners, AreWaitedForWhileTheyMove)
{
    CaseRun holds(hanging(1.05)), falls(hanging(0.95));
    holds.simulation.begin_stage(0);
    EXPECT_EQ(motion_of(holds), LinerMotion::rests) << "it has no weight yet";
    run_all(holds);
    EXPECT_EQ(motion_of(holds), LinerMotion::rests);
    run_all(falls);
    EXPECT_EQ(motion_of(falls), LinerMotion::has_come_off);
    EXPECT_TRUE(moving_liners(falls.model(), falls.state()).empty());
}

/// A lining of which a part stands out beyond the rock, once that has been taken away behind it: a beam on springs with a load on what stands out.
TEST(Liners, AreWaitedForWhileTheySwing)
{
    constexpr double k = 2e10, length = 1.2, modulus = 2e10, thickness = 0.2;
    LinerDef liner = lining();
    liner.path = {{2.0, 0.0}, {-2.0, 0.0}};
    liner.thickness = thickness;
    liner.modulus = modulus;
    liner.segment = 0.05;
    liner.normal_stiffness = k;
    liner.bond_strength = 1e9;
    CaseDef scene = hanging(1.0);
    scene.blocks[0].polygon = scenes::rectangle({-4.0, 0.0}, {0.8, 1.0});
    scene.blocks[1].polygon = scenes::rectangle({10.0, 0.0}, {18.0, 1.0});
    scene.blocks[2].polygon = scenes::rectangle({12.0, 1.0}, {16.0, 5.0});
    scenes::add_fixed_block(scene, "bench", scenes::rectangle({0.8, 0.0}, {4.0, 1.0}));
    scene.liners = {liner};
    scene.stages.push_back({.name = "dig", .until_converged = true, .max_cycles = 20000, .excavate = {"bench"}});
    for (const Method method : {Method::impulse, Method::force, Method::hybrid})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        EXPECT_TRUE(run_all(run).at(1).at_rest);
        const double q = run.model().support.liners[0].mass * 9.81, bending = modulus * std::pow(thickness, 3) / 12.0;
        const double b = std::pow(k / (4.0 * bending), 0.25), p = q * length, m = 0.5 * q * length * length;
        const double root = 2.0 * b * (p + m * b) / k + q / k, turned = 2.0 * b * b * (p + 2.0 * m * b) / k;
        const double tip = root + turned * length + q * std::pow(length, 4) / (8.0 * bending);
        EXPECT_NEAR(run.state().support.liners[0].displacement, tip, 0.015 * tip);
        EXPECT_NEAR(run.state().support.liners[0].moment, m, 0.03 * m) << "a little more behind the root";
    }
}

/// A ring in rock that does not move, under a pressure that parts it from the rock all around.
CaseDef ring_under_pressure(double strength_over_thrust)
{
    constexpr int sides = 24;
    constexpr double radius = 2.0, pressure = 2e5;
    CaseDef scene = hanging(1e3);
    scene.gravity = {0.0, 0.0};
    LinerDef& liner = scene.liners[0];
    liner.path.clear();
    const auto corner = [&](int i, double r)
    {
        const double angle = 2.0 * std::numbers::pi * (i % sides) / sides;
        return Vec2(r * std::cos(angle), r * std::sin(angle));
    };
    for (int i = 0; i < sides; ++i)
    {
        scenes::add_fixed_block(scene, "r" + std::to_string(i),
                                {corner(i, radius), corner(i, 1.5 * radius), corner(i + 1, 1.5 * radius), corner(i + 1, radius)});
        liner.path.push_back(corner(i, radius));
    }
    liner.path.push_back(liner.path.front());
    for (BlockDef& block : scene.blocks)
        if (block.name == "roof" || block.name == "stand" || block.name == "stone")
            for (Vec2& point : block.polygon)
                point.x() += 10.0;
    liner.thickness = 0.1;
    liner.modulus = 1e10;
    liner.segment = 1.0;
    liner.bond_strength = 0.0;
    liner.shear_stiffness = 0.0;
    liner.pressure = pressure;
    liner.pressure_cycles = 1000;
    liner.compressive_strength = strength_over_thrust * pressure * radius / liner.thickness;
    return scene;
}

TEST(Liners, HaveNotComeOffWhereTheyBearAsARing)
{
    CaseRun run(ring_under_pressure(2.0));
    EXPECT_TRUE(run_all(run).at(0).at_rest);
    const LinerRecord& record = run.state().support.liners[0];
    EXPECT_NEAR(record.parted, 24 * 4.0 * std::sin(std::numbers::pi / 24), 1e-6) << "all around";
    EXPECT_NEAR(record.thrust, 2e5 * 2.0, 0.02 * 2e5 * 2.0);
    EXPECT_EQ(motion_of(run), LinerMotion::rests);
}

TEST(Liners, AreNotAtRestWhileTheyCollapse)
{
    CaseRun run(ring_under_pressure(0.8));
    EXPECT_FALSE(run_all(run).at(0).at_rest);
    EXPECT_EQ(motion_of(run), LinerMotion::moves);
    EXPECT_NEAR(rest_of_liner(run.model(), run.state(), 0).unbalanced, 0.2, 0.05);
}

/// A block with smooth sides that hangs on a lining, between two that do not move.
TEST(Liners, CarryBlocksByImpulsesToRest)
{
    LinerDef liner = lining();
    liner.path = {{3.6, 0.0}, {-3.6, 0.0}};
    liner.thickness = 0.15;
    liner.modulus = 2e10;
    liner.segment = 0.3;
    liner.normal_stiffness = 1e9;
    liner.bond_strength = 1e9;
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "left", scenes::rectangle({-4.0, 0.0}, {-0.8, 4.0}));
    scenes::add_block(scene, "middle", scenes::rectangle({-0.8, 0.0}, {0.8, 1.6}));
    scenes::add_fixed_block(scene, "right", scenes::rectangle({0.8, 0.0}, {4.0, 4.0}));
    scene.joints[0].friction_angle_deg = 0.0;
    scene.gravity = {0.0, 0.0};
    scene.loads = {{.blocks = {"*"}, .acceleration = {0.0, -9.81}, .factor = {.ramp_cycles = Vec2(0.0, 1000.0)}}};
    scene.liners = {liner};
    scene.stages = {{.name = "hang", .until_converged = true, .max_cycles = 10000}};
    double moved[2];
    for (int by_impulses = 0; by_impulses < 2; ++by_impulses)
    {
        scene.contact.method = by_impulses == 1 ? Method::impulse : Method::force;
        CaseRun run(scene);
        EXPECT_TRUE(run_all(run).at(0).at_rest);
        moved[by_impulses] = run.state().support.liners[0].displacement;
        EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-4);
    }
    EXPECT_GT(moved[0], 1e-5);
    EXPECT_NEAR(moved[1], moved[0], 0.01 * moved[0]);
}

/// A wide ring swings slowly.
TEST(Liners, ComeToRestWhateverTheirPeriod)
{
    CaseDef scene = ring_under_pressure(2.0);
    for (BlockDef& block : scene.blocks)
        for (Vec2& point : block.polygon)
            point *= 12.5;
    for (Vec2& point : scene.liners[0].path)
        point *= 12.5;
    scene.liners[0].segment = 10.0;
    scene.liners[0].compressive_strength = 1e9;
    for (const Method method : {Method::impulse, Method::force})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        const StageResult stage = run_all(run).at(0);
        EXPECT_TRUE(stage.at_rest);
        EXPECT_LT(stage.cycles, 4000) << "without damping 8000";
        const double thrust = 2e5 * 25.0 * std::cos(std::numbers::pi / 24);
        EXPECT_NEAR(run.state().support.liners[0].thrust, thrust, 2e-3 * thrust);
    }
}

TEST(Liners, AreWaitedForWhileTheirPressureGrows)
{
    CaseDef scene = hanging(1e3);
    scene.liners[0].pressure = 2e4;
    scene.liners[0].pressure_cycles = 3000;
    scene.liners[0].hardening = {{{0.0, 0.5}, {50000.0, 1.0}}};
    CaseRun run(scene);
    const StageResult stage = run_all(run).at(0);
    EXPECT_TRUE(stage.at_rest);
    EXPECT_GT(stage.cycles, 3000);
    EXPECT_THAT(stage.to_come, testing::ElementsAre("liner \"liner\" hardens until cycle 50000")) << "forces stay as it hardens";
    const double whole = run.model().support.liners[0].mass * 9.81 + 2e4;  // [N/m]
    EXPECT_NEAR(run.state().support.liners[0].displacement, whole / 1e8, 1e-3 * whole / 1e8);
}

TEST(Liners, AreWaitedForWhileTheirStrengthFalls)
{
    CaseDef scene = hanging(1e3);
    scene.liners[0].hardening = {{{0.0, 1.0}, {4000.0, 0.5}}};
    CaseRun run(scene);
    EXPECT_GT(run_all(run).at(0).cycles, 4000);
}
}  // namespace
}  // namespace hdem
