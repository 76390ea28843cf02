#include "verification/unit/case_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::CaseRun;

/// A slab on a slope of 60 degrees: friction alone does not hold it.
CaseDef block_on_slope(double gap, Method method)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "slope", scenes::rectangle({-20.0, -1.0}, {20.0, 0.0}));
    scenes::add_block(scene, "block", scenes::rectangle({0.0, gap}, {4.0, 0.5 + gap}));
    scene.joints[0].cohesion = 1e6;
    scene.contact.method = method;
    scene = scenes::turned(scene, 60.0);
    scene.gravity = {0.0, -9.81};
    return scene;
}

double way(const CaseRun& run)
{
    return run.state().blocks.displacement(run.model().find_block("block")).norm();
}

TEST(DrawnJoints, HaveTheirCohesion)
{
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        CaseRun run(block_on_slope(0.0, method));
        run.advance(20000);
        EXPECT_LT(way(run), 1e-4);
    }
}

/// A joint that loses its cohesion when it breaks, and bears no tension: gaps of round-off as the block is turned, or of numbers that were rounded, do not break it.
TEST(DrawnJoints, AreWholeHoweverTheyAreDrawn)
{
    for (const double angle : {0.0, 10.0, 37.0, 161.0})
        for (const double gap : {0.0, 2e-5})
            for (const Method method : {Method::force, Method::hybrid, Method::impulse})
            {
                CaseDef scene = block_on_slope(gap, method);
                scene.joints[0].residual_friction_angle_deg = 20.0;
                scene.joints[0].residual_cohesion = 0.0;
                CaseRun run(scenes::turned(scene, angle));
                run.advance(20000);
                EXPECT_LT(way(run), 1e-4) << angle << " degrees, gap of " << gap << " m, method " << name_of(method);
            }
}

TEST(DrawnJoints, OfBlocksThatMeetLaterHaveNone)
{
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        CaseRun run(block_on_slope(0.05, method));
        const double step = run.model().time_step;
        run.advance(static_cast<std::int64_t>(1.2 / step));
        EXPECT_GT(way(run), 2.0);
    }
}

/// 1 MPa on 4 m would carry 75 times its weight.
TEST(DrawnJoints, DoNotHoldABlockThatFallsThreeMetres)
{
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        CaseRun run(block_on_slope(1.5, method));  // 3 m straight down
        run.advance(static_cast<std::int64_t>(2.0 / run.model().time_step));
        const BlockMotion& m = run.state().blocks.motion[run.model().find_block("block")];
        EXPECT_GT(std::hypot(m.vx, m.vy), 5.0);
    }
}

TEST(DrawnJoints, OfFixedBlocksHaveItOnceOneIsFreed)
{
    CaseDef scene = block_on_slope(0.0, Method::force);
    scene.blocks[1].fix_x = scene.blocks[1].fix_y = scene.blocks[1].fix_rotation = true;
    scenes::add_block(scene, "other", scenes::rectangle({50.0, 50.0}, {51.0, 51.0}));
    scene.stages = {{.name = "free", .cycles = 1, .free = {"block"}}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(20000);
    EXPECT_LT(way(run), 1e-4);
}

/// Four blocks around a point: round-off may say that those across it lie over each other. Held there by tension, they would swing as that bond comes and goes.
TEST(DrawnJoints, OfBlocksThatMeetInACornerHaveNone)
{
    for (const double angle : {0.0, 37.0, 61.0, 90.0, 123.0, 161.0})
        for (const Vec2& place : {Vec2(0.0, 0.0), Vec2(201.0, 103.0), Vec2(-3017.0, 911.0)})
        {
            CaseDef scene = scenes::empty_scene();
            for (int i = 0; i < 5; ++i)
                for (int j = 0; j < 5; ++j)
                    scenes::add_block(scene, fmt::format("b{}_{}", i, j), scenes::rectangle({i, j}, {i + 1.0, j + 1.0}));
            scene.joints[0].cohesion = 1e9;
            scene.joints[0].tension = 1e7;
            CaseRun run(scenes::moved(scenes::turned(scene, angle), place));
            const Contacts& contacts = run.state().contacts;
            int joined = 0;
            for (Index i = 0; i < contacts.size(); ++i)
                if (run.model().joints.has_memory(contacts.law[i]))
                    ++joined;
            EXPECT_EQ(joined, 40) << angle << " degrees, at " << place.transpose();
        }
}
}  // namespace
}  // namespace hdem
