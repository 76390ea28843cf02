#include "core/motion/step_check.h"
#include "verification/unit/case_run.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <cmath>

namespace hdem
{
namespace
{
using test::CaseRun;
using testing::HasSubstr;

constexpr double omega_bounce = 1610.1529717988;  // sqrt(7e9 / 2700), of a unit block that only moves up and down

/// A block 1 m over the ground comes down at 50 m/s; it may turn or not.
CaseDef thrown(double step, bool turns = true)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", scenes::rectangle({-3, -1}, {3, 0}));
    BlockDef& block = scenes::add_block(scene, "block", scenes::rectangle({-0.5, 1.0}, {0.5, 2.0}));
    block.velocity = {0.0, -50.0};
    block.fix_x = block.fix_rotation = !turns;
    scene.contact.method = Method::force;
    scene.time.step = step;
    return scene;
}

/// What 40 cycles end with.
std::string error_of(const CaseDef& scene, int threads = 1, int call = 40)
{
    CaseRun run(scene, threads);
    EXPECT_TRUE(run.simulation.find_problems().empty()) << "nothing touches at the start";
    try
    {
        for (int done = 0; done < 40; done += call)
            run.advance(call);
    }
    catch (const RunError& error)
    {
        EXPECT_LE(run.state().cycle, 40);
        return error.what();
    }
    return "none";
}

TEST(StepCheck, SeesAnImpactThatLastsOneCycle)
{
    const std::string error = error_of(thrown(5e-3));
    EXPECT_THAT(error, HasSubstr("cycle 5, time 0.025 s: "));
    EXPECT_THAT(error, HasSubstr("\"block\""));
    EXPECT_THAT(error, HasSubstr("\"ground\""));
    EXPECT_THAT(error, HasSubstr("time step = 0.005 s (above the stable limit"));
    EXPECT_THAT(error, HasSubstr("or none to use 8.783e-05 s"));
}

TEST(StepCheck, LeavesTheDefaultStepAndImpulsesAlone)
{
    CaseDef usual = thrown(0.0), impulse = thrown(5e-3), hybrid = thrown(5e-3);
    usual.time.step.reset();
    usual.blocks[1].velocity = {0.0, -1000.0};
    impulse.contact.method = Method::impulse;
    hybrid.contact.method = Method::hybrid;
    for (CaseDef scene : {usual, impulse, hybrid})
    {
        scene.contact.overlap_limit = 1.0;
        CaseRun run(scene);
        run.advance(40);
        EXPECT_GT(run.velocity("block").y(), -49.0) << "it has hit";
    }
}

/// Under the hybrid method what began with impulses rests on springs.
TEST(StepCheck, OfTheHybridMethodIsForContactsWithSprings)
{
    CaseDef scene = thrown(2e-3);
    scene.contact.method = Method::hybrid;
    scene.contact.restitution = 0.0;
    scene.blocks[1].velocity = {0.0, -1.0};
    CaseRun run(scene);
    EXPECT_THROW(run.advance(2000), RunError);
    EXPECT_TRUE(is_spring(run.state().contacts.regime[0][0]) || is_spring(run.state().contacts.regime[1][0]));
}

TEST(StepCheck, BeginsAtTheLimit)
{
    const double limit = 2.0 / omega_bounce;
    EXPECT_EQ(error_of(thrown(0.999 * limit, false)), "none");
    EXPECT_NE(error_of(thrown(1.001 * limit, false)), "none");
}

TEST(StepCheck, IsTheSameOnTwoThreadsAndCycleByCycle)
{
    CaseDef scene = thrown(5e-3);
    for (int i = 0; i < 600; ++i)  // two threads have enough to do
        scenes::add_fixed_block(scene, "left" + std::to_string(i), scenes::rectangle({10.0 + i, 0.0}, {11.0 + i, 1.0}));
    for (int i = 0; i < 600; ++i)
        scenes::add_block(scene, "top" + std::to_string(i), scenes::rectangle({10.0 + i, 1.05}, {10.9 + i, 2.0}));
    const std::string error = error_of(scene);
    EXPECT_NE(error, "none");
    EXPECT_EQ(error_of(scene, 2), error);
    EXPECT_EQ(error_of(scene, 1, 1), error);
    EXPECT_EQ(error_of(scene, 2, 3), error);
}

/// K_N in Eq. (32) is that of a contact 1 m long; hdem's own step knows longer ones.
TEST(StepCheck, NamesABetterStepWhereThatOfTheEquationIsTooGreat)
{
    CaseDef scene = thrown(0.0);
    scene.time.step.reset();
    scene.blocks[0].polygon = scenes::rectangle({-100, -10}, {100, 0});
    scene.blocks[1].polygon = scenes::rectangle({-50, 1}, {50, 2});
    EXPECT_EQ(error_of(scene), "none");
    scene.damping.preset = DampingPreset::paper;
    const std::string error = error_of(scene);
    EXPECT_THAT(error, HasSubstr("above the stable limit"));
    const std::string advice = "Give a smaller time.step, e.g. ";
    ASSERT_THAT(error, HasSubstr(advice));
    scene.time.step = std::stod(error.substr(error.find(advice) + advice.size()));
    CaseRun run(scene);
    run.advance(2000);
    run.simulation.check_state();
    EXPECT_LT(run.velocity("block").norm(), 51.0);
}

TEST(ClosingOf, LooksAtAllSpringsOnlyWhereOneIsQuick)
{
    const auto closing = [](double width, double height)
    {
        CaseDef scene = scenes::block_on_ground(width, height);
        scene.time.step = paper_time_step(2700.0, 7e9, 0.1);
        const CaseRun run(scene);
        return closing_of(greatest_answer({0, run.state().contacts.size()}, run.model(), run.state().contacts),
                          run.model().time_step);
    };
    EXPECT_EQ(closing(1.0, 1.0), Closing::fast_points);
    EXPECT_EQ(closing(10.0, 0.1), Closing::all_points);
}

/// A block between ground and roof: each contact by itself would be stable.
TEST(StepCheck, AddsUpTheContactsOfABlock)
{
    const auto error_after_a_cycle = [](double share)
    {
        CaseDef scene = thrown(share * 2.0 / (std::sqrt(2.0) * omega_bounce), false);
        scene.blocks[1].polygon = scenes::rectangle({-0.5, 0.0}, {0.5, 1.0});
        scene.blocks[1].velocity = {0.0, 0.0};
        scenes::add_fixed_block(scene, "roof", scenes::rectangle({-3, 1}, {3, 2}));
        CaseRun run(scene);
        run.advance();
        return test::message_of([&] { run.simulation.check_state(); });
    };
    EXPECT_EQ(error_after_a_cycle(0.999), "no error");
    EXPECT_THAT(error_after_a_cycle(1.001), HasSubstr("block \"block\": time step = 0.0008792 s (above the stable limit"));
}

TEST(StepCheck, LooksAtFewContactsIfAny)
{
    const auto stiff = [](double step)
    {
        CaseDef scene = scenes::voronoi(6, 6);
        scene.time.step = step;
        const CaseRun run(scene);
        std::vector<StiffContact> found;
        find_stiff_contacts({0, run.state().contacts.size()}, run.model(), run.state().blocks, run.state().contacts, found);
        return static_cast<double>(found.size()) / static_cast<double>(run.state().contacts.size());
    };
    EXPECT_EQ(stiff(5e-5), 0.0);
    EXPECT_EQ(stiff(1e-2), 1.0);
}
}  // namespace
}  // namespace hdem
