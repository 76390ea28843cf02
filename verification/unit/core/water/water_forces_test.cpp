#include "core/contact/contact_report.h"
#include "core/history_sampler.h"
#include "core/water/water_forces.h"
#include "core/water/wet_faces.h"
#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

constexpr double weight_of_water = 9810.0;  ///< [N/m3]

/// 6 x 6 blocks of 1 m, the outer ones fixed, an opening of 2 x 2 blocks in the middle.
CaseDef rock_below_water()
{
    CaseDef scene = square_pattern(6.0, 6.0);
    scene.gravity = {0.0, -9.81};
    scene.domain.fixed = {"left", "right", "bottom"};
    scene.excavations.push_back({.name = "room", .polygon = {{2, 2}, {4, 2}, {4, 4}, {2, 4}}});
    scene.water = {.given = true, .level = 20.0};
    scene.stages = {{.name = "stand", .cycles = 100}, {.name = "dig", .cycles = 1000, .excavate = {"room"}}};
    return scene;
}

Triple water_on(const CaseRun& run, const Vec2& centre)
{
    for (Index b = 0; b < run.model().blocks(); ++b)
        if ((run.state().blocks.reference_position[b] + run.model().origin - centre).norm() < 1e-6)
            return run.state().water[b];
    ADD_FAILURE() << "no block at " << centre.transpose();
    return {};
}

TEST(WaterForces, LiftABlockByTheWaterInItsPlace)
{
    CaseRun run(rock_below_water());
    for (const Vec2& centre : {Vec2(1.5, 1.5), Vec2(2.5, 2.5), Vec2(4.5, 3.5)})
    {
        const Triple on = water_on(run, centre);
        EXPECT_NEAR(on.x, 0.0, 1e-8);
        EXPECT_NEAR(on.y, weight_of_water, 1e-7);
        EXPECT_NEAR(on.w, 0.0, 1e-8);
    }
}

/// Where tilt_deg tilts the model, water lies level all the same.
TEST(WaterForces, TurnWithTheTiltOfTheModel)
{
    CaseDef scene = rock_below_water();
    scene.gravity_tilt_deg = 30.0;
    scene.histories = {{.name = "gauge", .point = Vec2(3.0, 2.0), .quantities = {"pore_pressure"}}};
    const CaseRun run(scene);
    const Triple on = water_on(run, {2.5, 2.5});
    EXPECT_NEAR(on.x, 0.5 * weight_of_water, 1e-7);
    EXPECT_NEAR(on.y, std::sqrt(0.75) * weight_of_water, 1e-7);
    EXPECT_NEAR(on.w, 0.0, 1e-8);
    double pressure = 0.0;
    HistorySampler(run.model(), scene.histories[0]).sample(run.model(), run.state(), {&pressure, 1});
    EXPECT_NEAR(pressure, weight_of_water * (20.0 - (0.5 * 3.0 + std::sqrt(0.75) * 2.0)), 1e-6);
}

TEST(WaterForces, AreGoneWhereABlockWasTakenOut)
{
    CaseRun run(rock_below_water());
    run.simulation.begin_stage(1);
    // Beside the opening, 2 to 3 m up: the pressure of its outer face pushes it in.
    const double push = weight_of_water * (20.0 - 2.5);
    EXPECT_NEAR(water_on(run, {1.5, 2.5}).x, push, 1e-6);
    EXPECT_NEAR(water_on(run, {4.5, 2.5}).x, -push, 1e-6);
    EXPECT_NEAR(water_on(run, {2.5, 1.5}).y, weight_of_water * (20.0 - 1.0), 1e-6);

    CaseDef scene = rock_below_water();
    scene.water.flooded = {"room"};
    CaseRun flooded(scene);
    flooded.simulation.begin_stage(1);
    EXPECT_NEAR(water_on(flooded, {1.5, 2.5}).x, 0.0, 1e-6);
}

TEST(WaterForces, PressOnNamedJointsAndFacesAsAsked)
{
    CaseDef scene = rock_below_water();
    scene.water.joints = {"default"};
    EXPECT_NEAR(water_on(CaseRun(scene), {2.5, 2.5}).y, weight_of_water, 1e-7);
    scene.joints.push_back(scene.joints[0]);
    scene.joints[1].name = "tight";
    scene.joint_sets[1].joint = "tight";  // the upright ones
    EXPECT_NEAR(water_on(CaseRun(scene), {2.5, 2.5}).y, weight_of_water, 1e-7);
    scene.joint_sets[0].joint = "tight";
    EXPECT_EQ(water_on(CaseRun(scene), {2.5, 2.5}).y, 0.0);

    scene = rock_below_water();
    scene.domain.fixed = {"bottom"};
    scene.water.ponded = false;
    const Triple top = water_on(CaseRun(scene), {2.5, 5.5});
    EXPECT_NEAR(top.y, weight_of_water * (20.0 - 5.0), 1e-6);
    scene.water.ponded = true;
    scene.boundaries = {pressed("top", 1e5)};
    EXPECT_NEAR(water_on(CaseRun(scene), {2.5, 5.5}).y, weight_of_water * (20.0 - 5.0), 1e-6);
}

TEST(WaterForces, ChangeWithTheStageAndComeSlowlyWhenAsked)
{
    CaseDef scene = rock_below_water();
    scene.stages = {{.name = "stand", .cycles = 100}, {.name = "drain", .cycles = 1000}};
    scene.stages[1].relax_cycles = 400;
    scene.stages[1].water_level = 0.0;
    CaseRun run(scene);
    run.simulation.begin_stage(1);
    EXPECT_EQ(water_on(run, {2.5, 2.5}).y, 0.0);
    double released = 0.0;
    for (const ReleasedForce& force : run.state().released)
        released += force.y;
    EXPECT_GT(released, 10.0 * weight_of_water);
    run.advance(400);
    EXPECT_TRUE(run.state().released.empty());
    EXPECT_LT(ledger_residual(run), 1e-9);
}

TEST(WaterForces, KeepTheLedgerAndFollowBlocksThatMove)
{
    CaseDef scene = rock_below_water();
    scene.joints[0].friction_angle_deg = 10.0;
    CaseRun run(scene);
    run.advance(100);
    run.simulation.begin_stage(1);
    const auto change = [&]
    {
        const std::vector<Triple> now = water_forces(run.model(), run.state(), run.state().water_until, 0.0);
        double greatest = 0.0;
        for (std::size_t b = 0; b < now.size(); ++b)
            greatest = std::max(greatest, std::hypot(now[b].x - run.state().water[b].x, now[b].y - run.state().water[b].y));
        return greatest;
    };
    run.advance(900);
    EXPECT_EQ(run.state().cycle, 1000);
    EXPECT_EQ(change(), 0.0);
    run.advance(100);
    EXPECT_GT(change(), 0.0);  // the roof has moved since
    EXPECT_LT(ledger_residual(run), 1e-9);
}

/// A field that is linear in x and y gives its gradient times the area.
TEST(WaterForces, OfAFieldFollowItsGradientAndMustReachTheRock)
{
    CaseDef scene = rock_below_water();
    scene.water = {.given = true};
    const auto plane = [](double x, double y) { return 2e5 + 3e3 * x - 1e4 * y; };
    for (const Vec2& p : {Vec2(-1, -1), Vec2(7, -1), Vec2(7, 7), Vec2(-1, 7), Vec2(2.3, 3.1)})
        scene.water.pressures.push_back({p.x(), p.y(), plane(p.x(), p.y())});
    const Triple on = water_on(CaseRun(scene), {2.5, 2.5});
    EXPECT_NEAR(on.x, -3e3, 1e-3);
    EXPECT_NEAR(on.y, 1e4, 1e-3);
    scene.gravity = {0.0, 0.0};
    EXPECT_NEAR(water_on(CaseRun(scene), {2.5, 2.5}).y, 1e4, 1e-3);
    scene.water.pressures[2] = {5.0, 5.0, 0.0};
    EXPECT_THROW(static_cast<void>(build_model(scene)), InputError);

    // Also a block that a stage frees.
    scene.water.pressures[2] = {7.0, 7.0, plane(7, 7)};
    scenes::add_fixed_block(scene, "aside", scenes::rectangle({20, 0}, {21, 1}));
    EXPECT_NO_THROW(static_cast<void>(build_model(scene)));
    scene.stages = {{.name = "free", .cycles = 1, .free = {"aside"}}};
    EXPECT_THROW(static_cast<void>(build_model(scene)), InputError);
}

/// What has fallen on a floor below a water table has no water under it, unless it is ponded: it would be pressed off the floor, fall again, and be thrown about.
TEST(WaterForces, OfJointsThatWereNotDrawnNeedPondedWater)
{
    CaseDef scene = scenes::block_on_ground();
    for (const bool is_ponded : {false, true})
        for (const double drawn : {0.0, 0.2, 1.5})
        {
            scene.blocks[1].polygon = scenes::rectangle({0.0, drawn}, {1.0, 1.0 + drawn});
            scene.water = {.given = true, .level = 12.0, .ponded = is_ponded};
            const CaseRun run(scene,
                              [&](const Model& model, State& state) { state.blocks.motion[model.find_block("block")].y -= drawn; });
            const double up = run.state().water[run.slot("block")].y;
            if (is_ponded)
                EXPECT_NEAR(up, weight_of_water, 1e-6 * weight_of_water) << drawn;
            else if (drawn < 1.0)
                EXPECT_NEAR(up, 12.0 * weight_of_water, 1e-6 * weight_of_water) << drawn;
            else
                EXPECT_EQ(up, 0.0) << drawn;
        }
}

/// The water of a crack goes with the faces on its line, until their block has moved a quarter of its size.
TEST(WaterForces, OfACrackStayWithItsFaces)
{
    CaseDef scene = rock_below_water();
    scene.water = {.given = true, .ponded = false};
    scene.water_cracks = {{.crack = {{3, 4}, {3, 3}}, .outlet = {{3, 3}, {6, 3}}, .level = 4.0}};
    const auto push = [&](double moved)
    {
        Index block = no_index;
        const CaseRun run(scene,
                          [&](const Model& model, State& state)
                          {
                              for (Index b = 0; b < model.blocks(); ++b)
                                  if ((state.blocks.reference_position[b] + model.origin - Vec2(3.5, 3.5)).norm() < 1e-6)
                                      block = b;
                              state.blocks.motion[block].x += moved;
                          });
        return run.state().water[block];
    };
    for (const double moved : {0.0, 0.03, 0.2})
        EXPECT_NEAR(push(moved).x, 0.5 * weight_of_water, 1e-6) << moved;
    EXPECT_GT(push(0.0).y, 0.9 * weight_of_water * 5.0 / 6.0);
    EXPECT_EQ(push(0.3).x, 0.0);
    // Its joint need not be one that other water gets into.
    const Triple open = push(0.0);
    scene.joints.push_back(scene.joints[0]);
    scene.joints.back().name = "other";
    scene.water.joints = {"other"};
    EXPECT_EQ(push(0.0).x, open.x);
    EXPECT_EQ(push(0.0).y, open.y);
}

/// Water stands in rock under stress: springs bear the effective part, and nothing moves.
TEST(WaterForces, AreReportedAsPressuresOfJointsAndPlaces)
{
    CaseDef scene = rock_below_water();
    scene.histories = {{.name = "gauge", .point = Vec2(3.0, 2.5), .quantities = {"pore_pressure"}}};
    scene.stages[1].water_level = 2.5;
    scene.stages[1].excavate.clear();
    CaseRun run(scene);
    HistorySampler gauge(run.model(), scene.histories[0]);
    double value = 0.0;
    gauge.sample(run.model(), run.state(), {&value, 1});
    EXPECT_NEAR(value, weight_of_water * 17.5, 1e-6);
    const auto look = [&](double level)
    {
        int wet = 0;
        for (Index i = 0; i < run.state().contacts.size(); ++i)
        {
            const ContactReport c = report_contact(run.state(), i);
            const double low = std::min(c.point[0].y(), c.point[1].y()) + run.model().origin.y();
            const double high = std::max(c.point[0].y(), c.point[1].y()) + run.model().origin.y();
            const double p = JointPressure(run.model(), run.state()).mean(i, c.point[0], c.point[1]);
            const double under = std::min(high, level);  // the wet part of an upright joint
            const double expected = low >= level        ? 0.0
                                    : high - low < 1e-9 ? level - low
                                                        : (level - 0.5 * (low + under)) * (under - low) / (high - low);
            EXPECT_NEAR(p, weight_of_water * expected, 1e-3) << low << " to " << high;
            wet += p > 0.0 ? 1 : 0;
        }
        return wet;
    };
    const int all = look(20.0);
    EXPECT_EQ(all, run.state().contacts.size());
    run.simulation.begin_stage(1);
    const int below = look(2.5);
    EXPECT_GT(below, 0);
    EXPECT_LT(below, all);
    gauge.sample(run.model(), run.state(), {&value, 1});
    EXPECT_EQ(value, 0.0) << "on the water table";

    scene.water.joints = {"other"};
    scene.joints.push_back(scene.joints[0]);
    scene.joints.back().name = "other";
    CaseRun dry(scene);
    for (Index i = 0; i < dry.state().contacts.size(); ++i)
    {
        const ContactReport c = report_contact(dry.state(), i);
        EXPECT_EQ(JointPressure(dry.model(), dry.state()).mean(i, c.point[0], c.point[1]), 0.0);
    }
}

TEST(WaterForces, OfACrackAreReportedOnItsLine)
{
    CaseDef scene = rock_below_water();
    scene.water.level.reset();
    scene.water_cracks.push_back({.crack = {{3, 6}, {3, 4}}, .outlet = {{3, 4}, {5, 4}}, .level = 5.5});
    scene.joints.push_back(scene.joints[0]);
    scene.joints.back().name = "other";
    for (const char* wet : {"default", "other"})
    {
        scene.water.joints = {wet};
        const CaseRun run(scene);
        int found = 0;
        for (Index i = 0; i < run.state().contacts.size(); ++i)
        {
            const ContactReport c = report_contact(run.state(), i);
            const Vec2 middle = 0.5 * (c.point[0] + c.point[1]) + run.model().origin;
            const double p = JointPressure(run.model(), run.state()).mean(i, c.point[0], c.point[1]);
            const double on_crack = (middle - Vec2(3.0, 4.5)).norm() < 1e-3 ? 1.0 : 0.0;          // from 0.5 to 1.5 m deep
            const double on_outlet = (middle - Vec2(4.5, 4.0)).norm() < 1e-3 ? 0.25 * 1.5 : 0.0;  // of 1.5 m, seeping out over 2 m
            if (c.length > 0.0 && on_crack + on_outlet > 0.0)
            {
                EXPECT_NEAR(p, weight_of_water * (on_crack + on_outlet), 1.0) << middle.transpose();
                ++found;
            }
        }
        EXPECT_EQ(found, 2) << wet;
    }
}

TEST(WaterForces, LeaveStressedRockWhereItIsDrawn)
{
    CaseDef scene = square_pattern(6.0, 6.0);
    scene.gravity = {0.0, -9.81};
    scene.domain.fixed = {"left", "right", "bottom", "top"};
    scene.joint_sets.push_back({.name = "c", .dip_deg = 37.0, .spacing = 2.3, .origin = Vec2(0.3, 0.2)});
    scene.insitu = {.given = true, .surface = 40.0, .ratio = 1.2};
    scene.water = {.given = true, .table = {{-1.0, 5.0}, {2.2, 4.1}, {7.0, 1.3}}};
    scene.joints[0].friction_angle_deg = 40.0;
    expect_nothing_moves(scene);
}
}  // namespace
}  // namespace hdem
