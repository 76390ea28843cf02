/// Joint laws in the cycle: direct shear, tension and what a restart keeps of them. The laws themselves: verification/unit/core/joint.

#include "core/contact/contact_report.h"
#include "core/joint/coulomb_residual.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double speed = 0.01, pressure = 1e6;  // [m/s], [Pa]

/// A block of `width` under constant pressure on `pieces` fixed ones, held against turning and moved to the right.
CaseDef shear_box(const JointDef& joint, int pieces = 1, double width = 1.0)
{
    CaseDef scene = scenes::empty_scene();
    const double piece = (width + (pieces > 1 ? 0.0 : 2.0)) / pieces, begin = -0.5 * piece * pieces;
    for (int i = 0; i < pieces; ++i)
        scenes::add_fixed_block(scene, "base" + std::to_string(i),
                                scenes::rectangle({begin + i * piece, -1.0}, {begin + (i + 1) * piece, 0.0}));
    scenes::add_block(scene, "block", scenes::rectangle({-0.5 * width, 0.0}, {0.5 * width, 0.5}));
    scene.joints = {joint};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    BlockDef& block = scene.blocks.back();
    block.fix_rotation = true;
    block.fix_x = true;
    scene.loads = {{.blocks = {"block"}, .force = {0.0, -pressure * width}},
                   {.blocks = {"block"}, .velocity_x = speed, .interval = {.from_time = 0.1}}};
    scene.stages = {{.name = "shear", .cycles = 1}};
    return scene;
}

struct Box
{
    double normal = 0.0, shear = 0.0, way = 0.0, opening = 0.0;
};

Box look(const CaseRun& run, double width = 1.0)
{
    Box box;
    const Contacts& contacts = run.state().contacts;
    for (Index i = 0; i < contacts.size(); ++i)
        for (int k = 0; k < 2; ++k)
        {
            box.normal += contacts.normal_force(k, i) / width;
            box.shear += std::abs(contacts.shear_force(k, i)) / width;
        }
    const Vec2 moved = run.state().blocks.displacement(run.model().find_block("block"));
    box.way = moved.x();
    box.opening = moved.y() + pressure / 1e10;
    return box;
}

std::int64_t cycles_until(const CaseRun& run, double way)
{
    return static_cast<std::int64_t>((way / speed + 0.1) / run.model().time_step) - run.state().cycle;
}

TEST(JointForces, PeakDropAndDilationInDirectShear)
{
    for (const auto& [pieces, width] : {std::pair{1, 1.0}, std::pair{2, 8.0}, std::pair{16, 16.0}})
    {
        CaseRun run(shear_box(scenes::sample_joints()[0], pieces, width));
        const double peak = 1e5 + pressure * std::tan(radians(30.0));
        run.advance(cycles_until(run, 0.99 * peak / 1e9));
        Box box = look(run, width);
        EXPECT_NEAR(box.shear, 1e9 * box.way, 1e-4 * peak) << pieces;
        run.advance(cycles_until(run, 1.05 * peak / 1e9));
        box = look(run, width);
        EXPECT_LT(box.shear / box.normal, std::tan(radians(25.0)) + 1e-9) << pieces;
        run.advance(cycles_until(run, 10e-3));
        box = look(run, width);
        EXPECT_NEAR(box.normal, pressure, 0.02 * pressure) << pieces;  // it trembles
        EXPECT_NEAR(box.shear / box.normal, 0.466308, 1e-6) << pieces;
        EXPECT_NEAR(box.opening, 0.881635e-3, 2e-3 * 0.881635e-3) << pieces;
        EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-6) << pieces;
    }
}
/// Ten cycles of +-5 mm.
TEST(JointForces, KeepTheLedgerOverTenReversals)
{
    for (const JointDef& joint : scenes::sample_joints())
    {
        CaseDef scene = shear_box(joint);
        scene.loads.pop_back();
        for (int i = 0; i < 20; ++i)  // 5 mm there, 10 mm back
            scene.loads.push_back({.blocks = {"block"},
                                   .velocity_x = i % 2 == 0 ? 0.1 : -0.1,
                                   .interval = {.from_time = i == 0 ? 0.05 : 0.1 * i, .until_time = 0.1 * (i + 1)}});
        CaseRun run(scene);
        run.advance(static_cast<std::int64_t>(2.0 / run.model().time_step));
        const int law = static_cast<int>(joint.law);
        EXPECT_GT(run.state().ledger.friction, 1e3) << law;
        EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-6) << law;
        EXPECT_LT(std::abs(run.state().ledger.contact_changes), 0.2 * run.state().ledger.friction) << law;
    }
}

/// rho g H = 26 487 Pa pull at its joint.
CaseDef hung_block(double tension, Method method)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "roof", scenes::rectangle({-1.0, 1.0}, {2.0, 2.0}));
    scenes::add_block(scene, "block", scenes::rectangle({0.0, 0.0}, {1.0, 1.0}));
    scene.joints[0].cohesion = 1e6;
    scene.joints[0].tension = tension;
    scene.contact.method = method;
    scene.insitu = {.given = true, .stress = StressDef{}, .gradient = {0.0, 2700.0 * 9.81, 0.0}};
    return scene;
}

TEST(JointForces, TensionHoldsABlockAtARoof)
{
    for (const Method method : {Method::force, Method::hybrid})
        for (const double tension : {26000.0, 26900.0, 50000.0})
        {
            CaseRun run(hung_block(tension, method));
            run.advance(20000);
            const double way = run.state().blocks.displacement(run.model().find_block("block")).norm();
            if (tension > 26487.0)
                EXPECT_LT(way, 1e-9) << tension;
            else
                EXPECT_GT(way, 0.5) << tension;
        }
}

/// The pull acts at once: the block swings to twice its stretch, less what damping takes.
/// A block that hangs at a wall by cohesion alone: nothing presses the joint, and no tension holds it. A gap far below any real one is no opening.
TEST(JointForces, CohesionWithoutTensionHoldsAJointThatNothingPresses)
{
    for (const int quarters : {0, 1, 2, 3})
        for (const double strength : {0.5, 3.0})
        {
            CaseDef scene = scenes::empty_scene();
            scenes::add_fixed_block(scene, "wall", scenes::rectangle({1.0, -1.0}, {2.0, 2.0}));
            scenes::add_block(scene, "block", scenes::rectangle({0.0, 0.0}, {1.0, 1.0})).fix_rotation = true;
            scene.joints[0].cohesion = strength * 2700.0 * 9.81;
            scene.joints[0].residual_cohesion = 0.0;
            scene.contact.method = Method::force;
            const auto turned = [&](Vec2 v)
            {
                for (int i = 0; i < quarters; ++i)
                    v = Vec2(-v.y(), v.x());
                return v;
            };
            for (BlockDef& block : scene.blocks)
                std::ranges::transform(block.polygon, block.polygon.begin(), turned);
            scene.gravity = turned({0.0, -9.81});
            CaseRun run(scene);
            run.advance(5000);
            EXPECT_EQ(run.displacement("block").norm() < 1e-3, strength > 1.0) << quarters << ", " << strength;
        }
}

TEST(JointForces, ABlockHungSuddenlyAsksForMore)
{
    CaseDef scene = hung_block(50000.0, Method::force);
    scene.insitu = {};
    CaseRun holds(scene);
    holds.advance(20000);
    EXPECT_NEAR(holds.state().blocks.displacement(holds.model().find_block("block")).y(), -26487.0 / 7e9, 1e-3 * 26487.0 / 7e9);
    scene.joints[0].tension = 26900.0;
    scene.damping.preset = DampingPreset::dynamic;
    CaseRun falls(scene);
    falls.advance(20000);
    EXPECT_GT(falls.state().blocks.displacement(falls.model().find_block("block")).norm(), 0.5);
}

/// A push of 30 kN for a moment breaks a joint that bears 50 kN at rest: then T_r counts.
TEST(JointForces, ABrokenJointHasItsResidualTension)
{
    for (const double residual : {0.0, 20000.0, 30000.0})
    {
        CaseDef scene = hung_block(50000.0, Method::force);
        scene.joints[0].residual_tension = residual;
        scene.loads = {{.blocks = {"block"}, .force = {0.0, -30000.0}, .interval = {.from_cycle = 100, .until_cycle = 400}}};
        CaseRun run(scene);
        run.advance(20000);
        const double way = run.state().blocks.displacement(run.model().find_block("block")).norm();
        if (residual > 26487.0)
            EXPECT_LT(way, 0.1) << residual;
        else
            EXPECT_GT(way, 0.5) << residual;
    }
}
}  // namespace
}  // namespace hdem
