/// Numbers of joints that a stage changes.

#include "io/case_reader.h"
#include "verification/unit/case_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::CaseRun;

/// A block on a slope of 30 degrees that holds by friction, until a stage lowers it.
std::string slope(const std::string& joint, const std::string& set)
{
    return R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
)" + joint +
           R"(
[gravity]
vector = [4.905, -8.495709]
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[-5, -1], [30, -1], [30, 0], [-5, 0]]
fixed = true
[[block]]
name = "block"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[stage]]
name = "hold"
cycles = 5000
[[stage]]
name = "weaker"
cycles = 10000
set = [)" + set +
           "]\n";
}

CaseDef read(const std::string& text)
{
    return read_case_text(text, "case.toml").def;
}

double way(const CaseRun& run)
{
    return run.state().blocks.displacement(run.model().find_block("block")).norm();
}

TEST(StageJoints, AreThoseOfTheStageFromItsStartOn)
{
    for (const std::string memory : {"", "residual_cohesion = 0.0\n"})
    {
        CaseRun run(read(slope("friction_angle_deg = 35.0\ncohesion = 1e3\n" + memory,
                               R"("joint.default.friction_angle_deg = 20", "joint.default.cohesion = 0")")));
        run.advance(5000);
        EXPECT_LT(way(run), 1e-4);
        run.simulation.begin_stage(1);
        const double t = 10000 * run.model().time_step;
        run.advance(10000);
        const double a = 9.81 * (0.5 - std::sqrt(0.75) * std::tan(20.0 * std::acos(-1.0) / 180.0));
        EXPECT_NEAR(way(run), 0.5 * a * t * t, 0.02 * 0.5 * a * t * t);
    }
}

TEST(StageJoints, StayAfterARestart)
{
    const CaseDef def = read(slope("friction_angle_deg = 35.0\n", R"("joint.default.friction_angle_deg = 20")"));
    CaseRun unbroken(def);
    unbroken.advance(5000);
    unbroken.simulation.begin_stage(1);
    unbroken.advance(2000);
    const std::uint64_t model = model_hash(unbroken.model());
    hdem::Setup again = build_model(def);
    EXPECT_EQ(model_hash(again.model), model);
    Simulation going_on(std::move(again.model), unbroken.state(), 1);
    going_on.advance(3000);
    unbroken.advance(3000);
    EXPECT_EQ(state_hash(going_on.model(), going_on.state()), state_hash(unbroken.model(), unbroken.state()));
}

TEST(StageJoints, AreRefusedWhereContactsBearByThem)
{
    const auto complaint = [](const std::string& set)
    {
        try
        {
            read(slope("friction_angle_deg = 35.0\n", set));
        }
        catch (const InputError& error)
        {
            return std::string(error.what());
        }
        return std::string("none");
    };
    using testing::HasSubstr;
    EXPECT_THAT(complaint(R"("joint.default.greatest_closure = 1e-3")"), HasSubstr("contacts bear by it already"));
    EXPECT_THAT(complaint(R"("joint.default.law = \"patton\"")"), HasSubstr("law"));
    EXPECT_THAT(complaint(R"("material.other.density = 5")"), HasSubstr("no material has this name"));
    EXPECT_THAT(complaint(R"("material.rock.density = -5")"), HasSubstr("density"));
    EXPECT_THAT(complaint(R"("joint.default.dilation_angle_deg = 5")"), HasSubstr("no memory"));
    EXPECT_THAT(complaint(R"("joint.other.cohesion = 5")"), HasSubstr("no joint has this name"));
    EXPECT_THAT(complaint(R"("joint.default.cohesion = 5", "joint.default.cohesion = 6")"),
                HasSubstr("sets joint.default.cohesion again"));
    EXPECT_THAT(complaint(R"("gravity = 5")"), HasSubstr("does not say joint.NAME.KEY = VALUE or material.NAME.density = VALUE"));
    EXPECT_THAT(complaint(R"("joint.default.cohesion = -5")"), HasSubstr("cohesion"));
    EXPECT_THAT(complaint(R"("joint.default.frction = 5")"), HasSubstr("unknown key"));
}
}  // namespace
}  // namespace hdem
