#include "core/motion/rest.h"
#include "core/motion/step_control.h"
#include "core/stage/load_changes.h"
#include "parallel/stages.h"
#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

/// The speed-ups of a stage that looks for rest come once nothing changes any more, and it does not end before.
TEST(LoadChanges, KeepAllBlocksAwakeUntilTheyAreOver)
{
    CaseDef scene = scenes::wall(6, 4);
    scene.stages = {{.name = "press", .until_converged = true, .max_cycles = 100'000}};
    scene.loads = {{.blocks = {"*"}, .acceleration = {0.0, -2.0}, .factor = {.ramp_cycles = Vec2(0.0, 3500.0)}}};
    CaseRun run(scene);
    const auto left_out_blocks = [&]
    { return std::ranges::count_if(run.state().blocks.rest, [](std::uint8_t rest) { return rest == left_out; }); };
    EXPECT_EQ(steady_from(run.model(), run.state()), 3501);
    EXPECT_FALSE(resolve_rules(run.model(), run.state()).rest.leaves_out);
    run.advance(3500);
    EXPECT_EQ(left_out_blocks(), 0);
    EXPECT_FALSE(resolve_rules(run.model(), run.state()).step.varies);
    run.advance(1);
    EXPECT_TRUE(resolve_rules(run.model(), run.state()).rest.leaves_out);
    EXPECT_TRUE(resolve_rules(run.model(), run.state()).step.varies);
    run.advance(30'000);
    EXPECT_GT(left_out_blocks(), 0);
    EXPECT_LT(ledger_residual(run), 1e-4) << "hybrid";
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
    const std::vector<StageResult> results = run_stages(simulation, {});
    EXPECT_TRUE(results[0].at_rest);
    EXPECT_GT(results[0].cycles, 3500);
    EXPECT_LT(results[0].cycles, 31'000);
}

/// Cycles stand for times only while all steps are the same.
TEST(LoadChanges, AtTimesToComeKeepTheStep)
{
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "settle", .until_converged = true, .max_cycles = 20'000}, {.name = "push", .cycles = 10'000}};
    scene.loads = {{.blocks = {"block"}, .force = {100.0, 0.0}, .interval = {.from_time = 1e3}}};
    CaseRun timed(scene);
    EXPECT_TRUE(are_times_to_come(timed.model(), timed.state()));
    EXPECT_FALSE(resolve_rules(timed.model(), timed.state()).step.varies);
    EXPECT_TRUE(resolve_rules(timed.model(), timed.state()).rest.leaves_out);
    scene.loads[0].interval = {.from_cycle = 1'000'000};
    CaseRun counted(scene);
    EXPECT_TRUE(resolve_rules(counted.model(), counted.state()).step.varies);
    scene.loads[0] = {.blocks = {"block"}, .force = {100.0, 0.0}, .factor = {.ramp_time = Vec2(0.0, 1.0), .since = "push"}};
    CaseRun later(scene);
    EXPECT_TRUE(resolve_rules(later.model(), later.state()).step.varies) << "counted from a stage that has not begun";
}

/// Where a load has come to its end within a stage, steps begin to vary there: no bound on them was looked at before, or that of another stage.
TEST(LoadChanges, AreFollowedByStepsThatAreStable)
{
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
        for (const bool is_second : {false, true})
        {
            SCOPED_TRACE(std::string(name_of(method)) + (is_second ? ", second stage" : ", first stage"));
            CaseDef scene = scenes::joints(6.0, 6.0, 1.0, 5.0);
            scene.contact.method = method;
            scene.stages.assign(is_second ? 2 : 1, {.name = "load", .until_converged = true, .max_cycles = 1000});
            scene.stages.back().name = "last";
            scene.loads = {
                {.blocks = {"*"}, .acceleration = {1.0, 0.0}, .factor = {.table = {{0.0, 0.0}, {201.0, 1.0}}, .since = "last"}}};
            CaseRun run(scene);
            if (is_second)
            {
                run.advance(700);
                run.simulation.begin_stage(1);
            }
            double least = run.model().time_step;
            for (int i = 0; i < 400; ++i)
            {
                run.advance();
                least = std::min(least, run.state().blocks.step.next);
                for (Index b = 0; b < run.model().blocks(); ++b)
                    ASSERT_TRUE(std::isfinite(run.state().blocks.motion[b].x)) << "cycle " << i;
            }
            EXPECT_GT(least, 0.1 * run.model().time_step);
            EXPECT_LT(ledger_residual(run), method == Method::force ? 1e-6 : 1e-4);
        }
}
/// While a load changes, contacts change and nobody looks at the step that they bear: what was looked at before is forgotten.
TEST(LoadChanges, LeaveNothingKnownOfStableSteps)
{
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "settle", .until_converged = true, .max_cycles = 20'000},
                    {.name = "push", .until_converged = true, .max_cycles = 20'000}};
    scene.loads = {{.blocks = {"block"}, .acceleration = {8.0, 0.0}, .factor = {.ramp_cycles = Vec2(0.0, 300.0), .since = "push"}}};
    CaseRun run(scene);
    const auto varies = [&] { return resolve_rules(run.model(), run.state()).step.varies; };
    const auto known = [&] { return run.state().blocks.stable_step[run.slot("block")]; };
    run.advance(500);
    ASSERT_TRUE(varies());
    EXPECT_GT(known(), 0.0);
    run.simulation.begin_stage(1);
    run.advance(200);
    ASSERT_FALSE(varies());
    EXPECT_EQ(known(), 0.0);
    run.advance(110);
    ASSERT_TRUE(varies());
    const State& state = run.state();
    BlockContacts list;
    list_block_contacts(state.contacts, state.blocks.size(), list);
    const double now = stable_step_of(run.slot("block"), run.model(), list, state.contacts, state.blocks);
    EXPECT_NEAR(known(), now, 1e-6 * now);
}
}  // namespace
}  // namespace hdem
