#include "io/load_case.h"
#include "parallel/stages.h"
#include "verification/unit/case_run.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double step = 1e-3;

/// A block in free flight without gravity, 2700 kg.
CaseDef flyer()
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
    scenes::add_block(scene, "other", scenes::rectangle({50, 0}, {51, 1}));
    scene.gravity = {0.0, 0.0};
    scene.time.step = step;
    return scene;
}

/// Cycles after which the block has moved under a load.
int loaded_cycles(const Interval& interval)
{
    CaseDef scene = flyer();
    scene.loads = {{.blocks = {"block"}, .acceleration = {1.0, 0.0}, .interval = interval}};
    CaseRun run(scene);
    run.advance(100);
    return static_cast<int>(std::lround(run.velocity("block").x() / (1.0 * step)));
}

TEST(Loads, ActFromAndUntilTheGivenCyclesOrTimes)
{
    EXPECT_EQ(loaded_cycles({}), 100);
    EXPECT_EQ(loaded_cycles({.from_cycle = 10}), 90);
    EXPECT_EQ(loaded_cycles({.from_cycle = 10, .until_cycle = 25}), 15);
    EXPECT_EQ(loaded_cycles({.from_time = 0.01, .until_time = 0.025}), 15);
    EXPECT_EQ(loaded_cycles({.until_time = 0.0105}), 11) << "a cycle that has begun is finished";
    EXPECT_EQ(loaded_cycles({.from_cycle = 20, .until_cycle = 20}), 0);
}

TEST(Loads, ActOnTheNamedBlocksWithForceAccelerationAndMoment)
{
    CaseDef scene = flyer();
    scene.loads = {{.blocks = {"block"}, .acceleration = {1.0, 2.0}, .force = {2700.0, 0.0}, .moment = 450.0}};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_NEAR((run.velocity("block") - Vec2(0.2, 0.2)).norm(), 0.0, 1e-14);
    EXPECT_NEAR(run.motion("block").w, 0.1, 1e-14);
    EXPECT_EQ(run.velocity("other").norm(), 0.0);
}

TEST(Loads, ReachAllFreeBlocksByAStar)
{
    CaseDef scene = flyer();
    scenes::add_fixed_block(scene, "rock", scenes::rectangle({-50, 0}, {-49, 1}));
    scene.loads = {{.blocks = {"*"}, .acceleration = {1.0, 0.0}}};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_NEAR(run.velocity("block").x(), 0.1, 1e-14);
    EXPECT_NEAR(run.velocity("other").x(), 0.1, 1e-14);
    EXPECT_EQ(run.velocity("rock").norm(), 0.0);
}

/// The star stands for the blocks that are free when the load acts; a block that is named besides is no second one.
TEST(Loads, ReachByAStarWhatAStageFreesAndEachBlockOnce)
{
    CaseDef scene = flyer();
    scenes::add_fixed_block(scene, "rock", scenes::rectangle({-50, 0}, {-49, 1}));
    scene.loads = {{.blocks = {"*", "block", "block"}, .acceleration = {1.0, 0.0}}};
    scene.stages = {{.name = "held", .cycles = 60}, {.name = "freed", .cycles = 40, .free = {"rock"}}};
    CaseRun run(scene);
    static_cast<void>(run_stages(run.simulation, {}));
    EXPECT_NEAR(run.velocity("block").x(), 0.1, 1e-14);
    EXPECT_NEAR(run.velocity("other").x(), 0.1, 1e-14);
    EXPECT_NEAR(run.velocity("rock").x(), 0.04, 1e-14);
}

/// A block that a stage fixes may be driven from there on, and one that a stage frees goes on with the velocity that it has.
TEST(PrescribedVelocity, HoldsWhileABlockIsFixed)
{
    CaseDef scene = flyer();
    scene.loads = {{.blocks = {"block"}, .velocity_x = 0.5, .factor = {.since = "driven"}},
                   {.blocks = {"block"}, .acceleration = {1.0, 0.0}, .factor = {.since = "freed"}}};
    scene.stages = {{.name = "free", .cycles = 10},
                    {.name = "driven", .cycles = 20, .fix = {"block"}},
                    {.name = "freed", .cycles = 30, .free = {"block"}}};
    CaseRun run(scene);
    static_cast<void>(run_stages(run.simulation, {}));
    EXPECT_NEAR(run.velocity("block").x(), 0.53, 1e-14);
}

TEST(PrescribedVelocity, MovesABlockThatLongAndStopsIt)
{
    CaseDef scene = scenes::block_on_ground();
    scene.time.step = step;
    scene.contact.method = Method::impulse;
    scene.blocks[0].velocity = {0.0, 0.0};
    scene.loads = {{.blocks = {"ground"}, .velocity_x = 0.5, .interval = {.from_cycle = 10, .until_cycle = 30}}};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_NEAR(run.displacement("ground").x(), 20 * 0.5 * step, 1e-14);
    EXPECT_EQ(run.velocity("ground").x(), 0.0);
    EXPECT_GT(run.displacement("block").x(), 1e-4) << "it takes the block along";
}

/// One load takes over where another ends, whichever is listed first.
TEST(PrescribedVelocity, PassesFromOneLoadToTheNextWithoutAGap)
{
    const LoadDef forth{.blocks = {"ground"}, .velocity_x = 0.5, .interval = {.until_cycle = 20}};
    const LoadDef back{.blocks = {"ground"}, .velocity_x = -0.5, .interval = {.from_cycle = 20, .until_cycle = 40}};
    for (const std::vector<LoadDef>& loads : {std::vector<LoadDef>{forth, back}, std::vector<LoadDef>{back, forth}})
    {
        CaseDef scene = scenes::block_on_ground();
        scene.time.step = step;
        scene.loads = loads;
        CaseRun run(scene);
        run.advance(40);
        EXPECT_NEAR(run.displacement("ground").x(), 0.0, 1e-15);
    }
}

/// What is wrong with the names of a case whose rock is cut from a domain.
std::vector<std::string> problems_of(const std::string& more)
{
    const std::string rock = "[domain]\nwidth = 8\nheight = 8\nfixed = [\"bottom\"]\n[[joint_set]]\ndip_deg = 0\nspacing = 2\n"
                             "[material.rock]\ndensity = 2700\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
                             "friction_angle_deg = 30\n[[excavation]]\nname = \"tunnel\"\nshape = \"circle\"\nposition = [4, 4]\n"
                             "diameter = 2\n[[bolt]]\nname = \"roof\"\nfrom = [2, 2.5]\nto = [2, 6.5]\narea = 1e-3\n";
    std::vector<std::string> texts;
    try
    {
        for (const Problem& warning : load_case(rock + more, {}, "case.toml", {}).warnings)
            texts.push_back(warning.text);
    }
    catch (const InputError& error)
    {
        for (const Problem& problem : error.problems())
            texts.push_back(problem.text);
    }
    return texts;
}

TEST(Names, ThatNothingHasAreSaidWithTheirPlaceAndTheNearestOne)
{
    using testing::ElementsAre;
    using testing::HasSubstr;
    using testing::StartsWith;
    EXPECT_THAT(problems_of("[[stage]]\ncycles = 1\nexcavate = [\"tunnel\"]\n"), testing::IsEmpty());
    EXPECT_THAT(problems_of("[[stage]]\ncycles = 1\n"), ElementsAre(HasSubstr("no stage removes it"))) << "said once";
    const auto stage = [](const char* key)
    {
        return problems_of("[[stage]]\ncycles = 1\nexcavate = [\"tunnel\"]\n[[stage]]\nname = \"next\"\ncycles = 1\n" +
                           std::string(key));
    };
    EXPECT_THAT(
        stage("excavate = [\"tunel\"]\n"),
        ElementsAre(StartsWith("case.toml:30:12: stage \"next\": excavate = \"tunel\" (no excavation or block has this name; "
                               "did you mean 'tunnel'?)")));
    EXPECT_THAT(stage("fix = [\"tunnel\"]\n"), ElementsAre(HasSubstr("fix = \"tunnel\" (is an excavation, not a block)")));
    EXPECT_THAT(stage("free = [\"b999\"]\n"), ElementsAre(HasSubstr("free = \"b999\" (no block has this name). The model has")));
    EXPECT_THAT(stage("[[load]]\nblocks = [\"b999\"]\nforce = [1, 0]\n"),
                ElementsAre(HasSubstr("load \"load1\": blocks = \"b999\" (no block")));
}

/// hdem check must find them: a run would stop at them only after its first lines.
/// What a stage does with a block that is gone has no effect, and an end of a stage waits for it in vain.
TEST(Names, OfBlocksThatAreGoneAreWarnedOf)
{
    CaseDef scene = flyer();
    scene.stages = {{.name = "before", .cycles = 1, .fix = {"block"}},
                    {.name = "dig", .cycles = 1, .excavate = {"block"}},
                    {.name = "after", .max_cycles = 9, .free = {"block", "other"}}};
    scene.stages[2].ends = {{.quantity = EndQuantity::displacement, .blocks = {"block"}, .limit = 1.0}};
    const std::vector<Problem> warnings = build_model(scene).warnings;
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[0].key, "stage[2].free");
    EXPECT_THAT(warnings[0].text, testing::HasSubstr("stage \"after\": free = \"block\" (has no effect"));
    EXPECT_EQ(warnings[1].key, "stage[2].until");
}

TEST(Names, OfBoltsAndLinersInHistoriesAreLookedUp)
{
    using testing::ElementsAre;
    using testing::HasSubstr;
    const auto history = [](const char* keys)
    {
        return problems_of(
            "[[stage]]\ncycles = 1\nexcavate = [\"tunnel\"]\n[[history]]\nname = \"h\"\nquantities = [\"status\"]\n" +
            std::string(keys));
    };
    EXPECT_THAT(history("bolt = \"roof\"\n"), testing::IsEmpty());
    EXPECT_THAT(history("bolt = \"rof\"\n"),
                ElementsAre(testing::StartsWith("case.toml:30:8: history \"h\": bolt = \"rof\" (no bolt has "
                                                "this name; did you mean 'roof'?)")));
    EXPECT_THAT(problems_of("[[stage]]\ncycles = 1\nexcavate = [\"tunnel\"]\n[[history]]\nname = \"h\"\nquantities = [\"thrust\"]\n"
                            "liner = \"ring\"\n"),
                ElementsAre(HasSubstr("history \"h\": liner = \"ring\" (no liner has this name)")));
}

TEST(Stages, ThatWouldTakeMoreCyclesThanCanBeCountedAreRefused)
{
    EXPECT_THAT(
        problems_of("[[stage]]\nduration = 1.0\nexcavate = [\"tunnel\"]\n[time]\nstep = 1e-16\n"),
        testing::ElementsAre(testing::HasSubstr("stage \"stage1\": duration (takes more than 1e15 cycles of the time step)")));
}
}  // namespace
}  // namespace hdem
