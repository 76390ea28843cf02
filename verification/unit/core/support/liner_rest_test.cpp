#include "core/support/liner_rest.h"
#include "verification/unit/core/support/liner_scenes.h"

#include <gmock/gmock.h>

#include <numbers>

namespace hdem
{
namespace
{
using namespace test;

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
