#include "parallel/stages.h"
#include "parallel/state_check.h"
#include "verification/unit/parallel/stage_changes.h"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

namespace hdem
{
namespace
{
using test::CaseRun;
using test::with_change;
using testing::HasSubstr;

std::string error_of(const CaseDef& scene)
{
    try
    {
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        run_stages(simulation, {});
    }
    catch (const RunError& error)
    {
        return error.what();
    }
    return "none";
}

TEST(RunChecks, NameTheBlockWhoseMotionIsNotFinite)
{
    CaseDef scene = scenes::empty_scene(5000);
    scenes::add_block(scene, "runaway", scenes::rectangle({0, 0}, {1, 1}));
    scene.time.step = 1.0;
    scene.loads = {{.blocks = {"runaway"}, .force = {1e308, 0.0}}};
    const std::string error = error_of(scene);
    EXPECT_THAT(error, HasSubstr("\"runaway\""));
    EXPECT_THAT(error, HasSubstr("cycle 1000"));
    EXPECT_THAT(error, HasSubstr("time.step"));
}

TEST(RunChecks, RefuseATimeStepThatVanishes)
{
    CaseDef scene = scenes::block_on_ground();
    scene.materials[0].density = 1e-320;
    const hdem::Setup setup = build_model(scene);
    const std::vector<Problem> problems = Simulation(setup.model, setup.state).find_problems();
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_THAT(problems[0].text, HasSubstr("time: step (none follows from Eq. (32): the lightest block, block, has a mass of"));
}

TEST(RunChecks, NameBothBlocksThatOverlapTooMuch)
{
    CaseDef scene = scenes::block_on_ground();
    scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1e5;  // the weight sinks in by 0.26 m
    scene.contact.method = Method::force;
    scene.stages[0].cycles = 5000;
    const std::string error = error_of(scene);
    EXPECT_THAT(error, HasSubstr("\"ground\""));
    EXPECT_THAT(error, HasSubstr("\"block\""));
    EXPECT_THAT(error, HasSubstr("contact.overlap_limit"));
    scene.contact.overlap_limit = 0.6;
    EXPECT_EQ(error_of(scene), "none");
}

/// Edges that are beside each other have an overlap too, of any size.
TEST(RunChecks, DoNotNameBlocksThatDoNotTouch)
{
    CaseDef scene = scenes::block_on_ground();
    scenes::add_block(scene, "neighbour", scenes::rectangle({0.505, 0.0}, {1.5, 1.0}));
    scene.stages[0].cycles = 10;
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state));
    run_stages(simulation, {});
    State state = simulation.state();
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        Contact contact = state.contacts.get(i);
        contact.point[0].overlap = contact.point[0].regime == Regime::open ? 10.0 : 1.0;
        state.contacts.put(i, contact);
    }
    try
    {
        refuse_overlap(simulation.model(), state);
        FAIL();
    }
    catch (const RunError& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("overlap = 1 m"));
        EXPECT_THAT(error.what(), HasSubstr("\"ground\""));
    }
}

/// A column under 100 m of rock.
CaseDef pressed_column()
{
    CaseDef scene = scenes::joints(4.0, 4.0, 1.0, 10.0);
    scene.joint_sets = {{.name = "flat", .spacing = 1.0}};
    scene.domain.fixed = {"bottom"};
    scene.insitu = {.given = true, .surface = 100.0, .ratio = 1.0};
    scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1e9;
    return scene;
}

/// What presses a joint further than contacts are searched for would be lost in a search.
TEST(RunChecks, RefuseJointsThatAreSofterThanTheSkinBears)
{
    CaseDef scene = pressed_column();
    const auto problems_at = [&](double stiffness)
    {
        scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = stiffness;
        const hdem::Setup setup = build_model(scene);
        return Simulation(setup.model, setup.state).find_problems();
    };
    EXPECT_TRUE(problems_at(1e9).empty());
    const std::vector<Problem> problems = problems_at(1e6);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_THAT(problems[0].text, HasSubstr("in-situ stress presses a joint by 2.6"));
    EXPECT_THAT(problems[0].text, HasSubstr("Give a greater skin, or stiffer joints."));
}

TEST(RunChecks, RefuseAStageThatMakesJointsTooSoft)
{
    CaseDef scene = with_change(pressed_column(), [](JointDef& j) { j.normal_stiffness = 1e6; });
    scene.stages[0].cycles = scene.stages[1].cycles = 10;
    const std::string error = error_of(scene);
    EXPECT_THAT(error, HasSubstr("cycle 10,"));
    EXPECT_THAT(error, HasSubstr("stage \"changed\": set makes joints so soft that they are pressed by 2.6"));
}

/// A step that the stiffer joints of a later stage do not bear ends the run in the cycle in which they act.
TEST(RunChecks, RefuseAStepThatAStageWithStiffJointsDoesNotBear)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::force;
    scene = with_change(scene, [](JointDef& j) { j.normal_stiffness *= 1e4; });
    scene.time.step = 1e-4;
    scene.stages[0].cycles = 1000;
    const std::string error = error_of(scene);
    EXPECT_THAT(error, HasSubstr("step = 0.0001 s (above the stable limit 2/omega_max = "));
    EXPECT_THAT(error, HasSubstr("Give a smaller time.step"));
}
}  // namespace
}  // namespace hdem
