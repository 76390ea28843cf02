#include "io/stage_end_text.h"
#include "parallel/stages.h"
#include "verification/unit/case_run.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<StageResult> run_all(const CaseDef& scene, int threads = 1)
{
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state), threads);
    return run_stages(simulation, {});
}

std::vector<StageEndDef> ends(const std::vector<std::string>& texts)
{
    std::vector<StageEndDef> all;
    for (const std::string& text : texts)
    {
        EXPECT_EQ(read_stage_end(text).why, "") << text;
        all.push_back(read_stage_end(text).end);
    }
    return all;
}

/// A block in space that gravity takes along: s = g t^2 / 2.
CaseDef falling(const std::vector<std::string>& until)
{
    CaseDef scene = scenes::empty_scene(0);
    scenes::add_block(scene, "stone", scenes::rectangle({0, 0}, {1, 1}));
    scenes::add_block(scene, "other", scenes::rectangle({50, 0}, {51, 1}));
    scene.time.step = 1e-3;
    scene.damping.preset = DampingPreset::dynamic;
    scene.gravity = {0.0, -10.0};
    scene.stages = {{.name = "fall", .ends = ends(until), .max_cycles = 5000}};
    return scene;
}

TEST(StageEnds, AreMetAtADisplacementOrASpeed)
{
    const StageResult moved = run_all(falling({"displacement:stone > 1.25"}))[0];
    EXPECT_NEAR(moved.time, 0.5, 0.011) << "looked at every ten cycles";
    EXPECT_EQ(moved.cycles % 10, 0);
    EXPECT_EQ(moved.ended_by, 0);
    EXPECT_GE(moved.value, 1.25);
    EXPECT_FALSE(moved.at_rest);
    EXPECT_TRUE(moved.met_end());
    EXPECT_NEAR(run_all(falling({"speed > 3 for 0.1 s"}))[0].time, 0.4, 0.011);
    EXPECT_NEAR(run_all(falling({"speed > 3 for 100 cycles"}))[0].time, 0.4, 0.011);
    EXPECT_NEAR(run_all(falling({"time > 0.25"}))[0].time, 0.25, 1e-9);
    EXPECT_EQ(run_all(falling({"cycles > 120"}))[0].cycles, 120);
}

TEST(StageEnds, AreThatOfTheBlocksTheyName)
{
    CaseDef scene = falling({"displacement:other > 0.1"});
    scene.blocks[1].fix_x = scene.blocks[1].fix_y = scene.blocks[1].fix_rotation = true;
    EXPECT_EQ(run_all(scene)[0].ended_by, ended_by::limit) << "it does not move";
    scene.stages[0].ends = ends({"displacement:other,stone > 0.1"});
    EXPECT_EQ(run_all(scene)[0].ended_by, 0);
}

TEST(StageEnds, TheFirstThatIsMetCounts)
{
    const StageResult result = run_all(falling({"displacement > 100", "time > 3", "speed > 2"}))[0];
    EXPECT_EQ(result.ended_by, 2);
    EXPECT_NEAR(result.time, 0.2, 0.011);
    const StageResult both = run_all(falling({"time > 0.2", "cycles > 200"}))[0];
    EXPECT_EQ(both.ended_by, 0) << "in the order of the list";
}

TEST(StageEnds, OfALaterStageCountFromItsStart)
{
    CaseDef scene = falling({"time > 0.2"});
    scene.stages.push_back({.name = "on", .ends = ends({"time > 0.3"}), .max_cycles = 5000});
    scene.stages.push_back({.name = "down", .ends = ends({"displacement > 1"}), .max_cycles = 5000});
    const std::vector<StageResult> results = run_all(scene);
    EXPECT_NEAR(results[1].time, 0.5, 1e-9);
    EXPECT_NEAR(results[2].time - 0.5, (std::sqrt(25.0 + 20.0) - 5.0) / 10.0, 0.011) << "1 = 5 t + 5 t^2";
}

TEST(StageEnds, AreNotMetWithinMaxCycles)
{
    CaseDef scene = falling({"displacement > 1e4"});
    scene.stages[0].max_cycles = 77;
    const StageResult result = run_all(scene)[0];
    EXPECT_EQ(result.cycles, 77);
    EXPECT_EQ(result.ended_by, ended_by::limit);
    EXPECT_FALSE(result.met_end());
}

CaseDef resting(const std::vector<std::string>& until)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::force;
    scene.convergence.least_cycles = 100;
    scene.stages = {{.name = "settle", .ends = ends(until), .max_cycles = 50'000}};
    return scene;
}

TEST(StageEnds, OfMotionEndAtRestWhereNothingCanHappen)
{
    const StageResult result = run_all(resting({"displacement:block > 0.5"}))[0];
    EXPECT_EQ(result.ended_by, ended_by::nothing_more);
    EXPECT_TRUE(result.at_rest);
    EXPECT_TRUE(result.met_end());
    EXPECT_LT(result.cycles, 20'000);
    EXPECT_EQ(run_all(resting({"displacement:block > 0.5", "cycles > 30000"}))[0].cycles, 30'000) << "the clock still runs";

    CaseDef driven = resting({"displacement:block > 1e-4"});
    driven.loads = {{.blocks = {"ground"}, .velocity_x = 1e-4}};
    EXPECT_EQ(run_all(driven)[0].ended_by, 0) << "slower than what counts as at rest, but it goes on";
}

/// What rounding leaves of the springs' forces is a good part of the light block's weight; and one block has nearly all the weight of the model.
TEST(StageEnds, ComeToAHeavyBlockOnALightOne)
{
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
        for (const double angle : {0.0, 37.0, 211.0})
        {
            CaseDef scene = scenes::empty_scene();
            scene.contact.method = method;
            scene.materials.push_back({.name = "light", .density = 0.04});
            scenes::add_fixed_block(scene, "ground", scenes::rectangle({-9.0, -2.0}, {9.0, 0.0}));
            scenes::add_block(scene, "plate", scenes::rectangle({-2.36, 0.0}, {2.36, 0.24})).material = "light";
            scenes::add_block(scene, "stone", {{-2.12, 0.24}, {2.12, 0.24}, {1.18, 3.54}, {-1.65, 3.54}});
            scene.stages = {{.name = "rest", .cycles = {}, .until_converged = true, .max_cycles = 200'000}};
            const StageResult result = run_all(scenes::turned(scene, angle))[0];
            EXPECT_TRUE(result.at_rest) << "turned by " << angle;
        }
}

/// Ten million cycles of its step take the time in which a block that slips would show itself.
TEST(StageEnds, ComeToASmallBlockThatHasStoppedBeforeTheFirstLook)
{
    CaseDef scene = scenes::empty_scene();
    scene.joints.front().normal_stiffness = scene.joints.front().shear_stiffness = 1e12;
    scenes::add_fixed_block(scene, "ground", scenes::rectangle({-4e-3, -2e-3}, {4e-3, 0.0}));
    scenes::add_block(scene, "grain", scenes::rectangle({-2e-3, 0.0}, {2e-3, 2e-3}));
    scene.stages = {{.name = "rest", .cycles = {}, .until_converged = true, .max_cycles = 20'000}};
    EXPECT_TRUE(run_all(scene)[0].at_rest);
}

TEST(StageEnds, WaitForLoadsThatChange)
{
    for (const char* until : {"quiet for 0.01 s", "speed < 1e-3", "displacement within 1e-6 for 0.01 s", "displacement > 1"})
    {
        CaseDef scene = resting({until});
        const std::int64_t without = run_all(scene)[0].cycles;
        scene.loads = {{.blocks = {"block"}, .force = {0.0, -1e3}, .factor = {.ramp_cycles = Vec2(0.0, 20'000.0)}}};
        const StageResult result = run_all(scene)[0];
        EXPECT_LT(without, 20'000) << until;
        EXPECT_GT(result.cycles, 20'000) << until;
        EXPECT_TRUE(result.met_end()) << until;
        EXPECT_THAT(result.to_come, IsEmpty()) << until;
    }
}

TEST(StageEnds, QuietBeginsAnewWhenAJointOpensOrSlides)
{
    CaseDef scene = resting({"quiet for 0.2 s"});
    const StageResult alone = run_all(scene)[0];
    scene.loads = {{.blocks = {"block"}, .force = {0.0, 3e5}, .interval = {.from_time = 0.1, .until_time = 0.101}}};  // lifts it
    const StageResult lifted = run_all(scene)[0];
    EXPECT_GT(lifted.time, 0.101 + 0.2);
    EXPECT_LT(alone.time, lifted.time);
    EXPECT_EQ(lifted.ended_by, 0);
}

TEST(StageEnds, CloseOnTheHistoryThatTheyName)
{
    CaseDef scene = resting({"history:base.normal_force > 2e4"});
    scene.histories = {{.name = "base", .between = {"ground", "block"}, .quantities = {"overlap"}}};
    scene.loads = {{.name = "push", .blocks = {"block"}, .force = {0.0, -1e5}, .factor = {.ramp_cycles = Vec2(0.0, 40'000.0)}}};
    const StageResult result = run_all(scene)[0];
    EXPECT_EQ(result.ended_by, 0) << "at once, while the load grows";
    EXPECT_GE(result.value, 2e4);
    ASSERT_EQ(result.to_come.size(), 1u);
    EXPECT_EQ(result.to_come[0], "load \"push\" changes until cycle 40000");
}

TEST(StageEnds, SayWhatIsStillToCome)
{
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "one", .cycles = 100, .relax_cycles = 0}, {.name = "two", .cycles = 100}};
    scene.loads = {
        {.name = "load1", .blocks = {"block"}, .force = {1.0, 0.0}, .factor = {.ramp_cycles = Vec2(0.0, 150.0)}},
        {.name = "load2", .blocks = {"block"}, .force = {1.0, 0.0}, .interval = {.from_cycle = 500}},
        {.name = "load3", .blocks = {"block"}, .force = {1.0, 0.0}, .factor = {.ramp_cycles = Vec2(0.0, 120.0), .since = "two"}},
        {.name = "load4",
         .blocks = {"block"},
         .force = {1.0, 0.0},
         .interval = {.until_cycle = 50},
         .factor = {.ramp_cycles = Vec2(0.0, 900.0)}},
        {.name = "load5", .blocks = {"block"}, .force = {1.0, 0.0}, .interval = {.until_cycle = 700}}};
    const std::vector<StageResult> results = run_all(scene);
    EXPECT_THAT(results[0].to_come, ElementsAre("load \"load1\" changes until cycle 150"));
    EXPECT_THAT(results[1].to_come, ElementsAre("load \"load2\" begins in cycle 500", "load \"load3\" changes until cycle 220"));
}

/// A stage that seeks rest does not wait for what comes after its last cycle.
TEST(StageEnds, SayWhichLoadsEndLater)
{
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "rest", .cycles = {}, .until_converged = true, .max_cycles = 20'000}};
    scene.loads = {{.name = "prop", .blocks = {"block"}, .force = {1.0, 0.0}, .interval = {.until_cycle = 25'000}}};
    const StageResult result = run_all(scene)[0];
    EXPECT_TRUE(result.at_rest);
    EXPECT_THAT(result.to_come, ElementsAre("load \"prop\" ends in cycle 25000"));
}

/// The criteria of rest know nothing of what a block that moves on will meet.
TEST(StageEnds, AtRestSayWhichMotionsGoOn)
{
    const auto to_come = [](const CaseDef& scene) { return run_all(scene)[0].to_come; };
    CaseDef scene = scenes::block_on_ground();
    scenes::add_fixed_block(scene, "pusher", scenes::rectangle({-2.0, 0.0}, {-1.0, 1.0}));
    scene.stages = {{.name = "rest", .until_converged = true}};
    EXPECT_THAT(to_come(scene), IsEmpty());
    scene.loads = {{.name = "push", .blocks = {"pusher"}, .velocity_x = 1e-4}};
    EXPECT_THAT(to_come(scene), ElementsAre("load \"push\" moves its blocks on"));
    scene.loads[0].velocity_x = 0.0;
    EXPECT_THAT(to_come(scene), IsEmpty()) << "it holds them";
    scene.loads[0].velocity_x = 1e-4;
    scene.loads[0].interval = {.until_cycle = 50};
    EXPECT_THAT(to_come(scene), IsEmpty());
    scene.loads = {};
    scene.blocks.back().velocity = {1e-4, 0.0};
    EXPECT_THAT(to_come(scene), ElementsAre("fixed blocks move on with their velocity"));
}

TEST(StageEnds, AreTheSameOnAnyNumberOfThreads)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.0, 3.0);
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {6.0, 6.0}, .diameter = 4.0}};
    scene.convergence.least_cycles = 100;
    scene.stages = {{.name = "dig",
                     .ends = ends({"quiet for 0.05 s", "displacement > 1e-3", "unbalanced_force_ratio < 1e-7"}),
                     .max_cycles = 3000,
                     .excavate = {"tunnel"}}};
    const StageResult one = run_all(scene)[0];
    EXPECT_NE(one.ended_by, ended_by::limit);
    for (const int threads : {2, 3})
    {
        const StageResult more = run_all(scene, threads)[0];
        EXPECT_EQ(more.cycles, one.cycles);
        EXPECT_EQ(more.ended_by, one.ended_by);
        EXPECT_EQ(more.value, one.value);
    }
}
}  // namespace
}  // namespace hdem
