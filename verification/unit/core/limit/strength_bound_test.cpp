#include "core/limit/force_points.h"
#include "core/limit/linear_program.h"
#include "core/limit/strength_bound.h"
#include "io/case_reader.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(LinearProgram, MaximisesInTwoUnknowns)
{
    // max 3 x + 2 y, x + y = 4 - s, x + 3 y = 6 - r, x <= 3
    LinearProgram program(2);
    const int x = program.add_column(0.0, 3.0, -3.0, {{0, 1.0}, {1, 1.0}});
    program.add_column(0.0, infinity, -2.0, {{0, 1.0}, {1, 3.0}});
    program.add_column(0.0, infinity, 0.0, {{0, 1.0}});
    program.add_column(0.0, infinity, 0.0, {{1, 1.0}});
    program.set_row(0, 4.0);
    program.set_row(1, 6.0);
    EXPECT_EQ(program.solve(1000), LinearProgram::Status::optimal);
    EXPECT_NEAR(program.cost(), -11.0, 1e-9);
    program.change_bounds(x, 0.0, 1.0);
    EXPECT_EQ(program.solve(1000), LinearProgram::Status::optimal);
    EXPECT_NEAR(program.cost(), -3.0 - 10.0 / 3.0, 1e-9);
    program.change_column(x, {{0, 1.0}, {1, 13.0}});
    EXPECT_EQ(program.solve(1000), LinearProgram::Status::optimal);
    EXPECT_NEAR(program.cost(), -4.0, 1e-9);
}

/// A wedge in a notch: its two faces balance all of its weight. One number is round-off.
TEST(LinearProgram, IsNotLedAstrayByRoundOff)
{
    const double roundoff = -5.5511151231257827e-17;
    LinearProgram program(3);
    for (const std::array<double, 3>& edge : {std::array{-0.96791554912883448, -0.52970021881119322, 0.74642755300449637},
                                              std::array{-0.21639021306373629, -1.0819510653186817, 0.29231975497412915},
                                              std::array{-0.96791554912883448, -0.52970021881119322, -0.51955662315193685},
                                              std::array{-0.21639021306373629, -1.0819510653186817, -0.97366523032665442},
                                              std::array{0.70923765511080816, -0.84523652348139899, 1.1033244779120013},
                                              std::array{1.1033779189624917, roundoff, 0.71740961136551673},
                                              std::array{0.70923765511080816, -0.84523652348139899, -0.38636145957799667},
                                              std::array{1.1033779189624917, roundoff, -0.77227727824614467}})
        program.add_column(0.0, infinity, 0.0, {{0, edge[0]}, {1, edge[1]}, {2, edge[2]}});
    program.add_column(0.0, 1.0, -1.0, {{0, -0.70020753820970971}, {1, 1.0}});
    EXPECT_EQ(program.solve(1000), LinearProgram::Status::optimal);
    EXPECT_NEAR(program.cost(), -1.0, 1e-9);
}

std::string slab(const std::string& joint, const std::string& more = "")
{
    return R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
)" + joint +
           R"(
[gravity]
tilt_deg = 20.0
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[-6, -1], [10, -1], [10, 0], [-6, 0]]
fixed = true
[[block]]
name = "slab"
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[stage]]
cycles = 3000
)" + more;
}

StrengthBound bound_of(const std::string& text, const std::vector<std::uint8_t>& weakened = {})
{
    test::CaseRun run(read_case_text(text, "case.toml").def);
    run.simulation.begin_stage(0);
    run.advance(3000);
    return strength_bound(run.model(), run.state(), weakened, 1.0 / 128.0, 64.0);
}

double tan_deg(double degrees)
{
    return std::tan(degrees * std::acos(-1.0) / 180.0);
}

TEST(StrengthBound, IsThatOfASlabOnASlope)
{
    const double weight = 2700.0 * 9.81;
    const double friction = tan_deg(30.0) / tan_deg(20.0), cohesion = 4e3 / (weight * std::sin(std::acos(-1.0) / 9.0));
    const StrengthBound plain = bound_of(slab("friction_angle_deg = 30.0\n"));
    EXPECT_EQ(plain.end, StrengthBound::End::found);
    EXPECT_NEAR(plain.factor, friction, 2e-4 * friction);
    const StrengthBound with_c = bound_of(slab("friction_angle_deg = 30.0\ncohesion = 4e3\n"));
    EXPECT_NEAR(with_c.factor, friction + cohesion, 2e-4 * (friction + cohesion));
    // tau <= c + sigma tan phi holds with and without tension
    const StrengthBound with_t = bound_of(slab("friction_angle_deg = 30.0\ncohesion = 4e3\ntension = 5e3\n"));
    EXPECT_NEAR(with_t.factor, friction + cohesion, 2e-4 * (friction + cohesion));
}

/// A load that has grown to half of what the case gives pushes with that half.
TEST(StrengthBound, KnowsLoadsAsTheyActNow)
{
    const double angle = std::acos(-1.0) / 9.0, weight = 4.0 * 2700.0 * 9.81, push = 4e4;
    const double factor = weight * std::cos(angle) * tan_deg(30.0) / (weight * std::sin(angle) + 0.5 * push);
    const StrengthBound bound = bound_of(slab("friction_angle_deg = 30.0\n", R"([[load]]
blocks = ["slab"]
force = [-4e4, 0]
table = [[0, 0], [2000, 0.5]]
)"));
    EXPECT_NEAR(bound.factor, factor, 2e-4 * factor);
}

/// Two blocks on planes of 50 and 15 degrees: 1.25673 by limit equilibrium. Where the tip of the upper one meets the bend of the ground it stands on the lower plane.
TEST(StrengthBound, OfAWedgeWhoseTipStandsOnAnotherPlane)
{
    const std::string text = R"([material.rock]
density = 2650.0
[joint.default]
normal_stiffness = 5e9
shear_stiffness = 2e9
friction_angle_deg = 30.0
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[0, 0], [0, -5], [25, -5], [25, 12], [17.8208348887, 12], [10, 2.67949192431]]
fixed = true
[[block]]
polygon = [[0, 0], [10, 2.67949192431], [10, 12], [0, 6]]
[[block]]
polygon = [[10, 2.67949192431], [17.8208348887, 12], [10, 12]]
[[stage]]
cycles = 3000
)";
    test::CaseRun run(read_case_text(text, "case.toml").def);
    run.simulation.begin_stage(0);
    run.advance(3000);
    const StrengthBound whole = strength_bound(run.model(), run.state(), {}, 1.0 / 128.0, 64.0);
    EXPECT_NEAR(whole.factor, 1.25673, 1e-3);
    const StrengthBound crushed = strength_bound_without_corners(run.model(), run.state(), {}, 1.0 / 128.0, whole);
    EXPECT_EQ(crushed.end, StrengthBound::End::found);
    EXPECT_NEAR(crushed.factor, 1.25673, 1e-3);
}

/// Plane failure: 1.2145 by limit equilibrium. The tip of the wedge stands on the floor before the slope, which holds it at any strength.
TEST(StrengthBound, OfAWedgeWhoseTipStandsOnTheFloor)
{
    const std::string text = R"([material.rock]
density = 2500.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 2.5e9
friction_angle_deg = 32.0
cohesion = 15e3
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[-12, -12], [29.1377760809, -12], [29.1377760809, 12], [17.1377760809, 12], [0, 0], [-12, 0]]
fixed = true
[[block]]
polygon = [[0, 0], [17.1377760809, 12], [5.5956918979, 12], [-0.004, 0]]
[[stage]]
cycles = 3000
)";
    test::CaseRun run(read_case_text(text, "case.toml").def);
    run.simulation.begin_stage(0);
    run.advance(3000);
    const StrengthBound whole = strength_bound(run.model(), run.state(), {}, 1.0 / 128.0, 64.0);
    EXPECT_GT(whole.factor, 2.0);
    const StrengthBound crushed = strength_bound_without_corners(run.model(), run.state(), {}, 1.0 / 128.0, whole);
    EXPECT_EQ(crushed.end, StrengthBound::End::found);
    EXPECT_NEAR(crushed.factor, 1.2145, 1e-3);
}

/// Where no corner bears, both are the same.
TEST(StrengthBound, WithoutCornersIsThatOfFaces)
{
    test::CaseRun run(read_case_text(slab("friction_angle_deg = 30.0\n"), "case.toml").def);
    run.simulation.begin_stage(0);
    run.advance(3000);
    const StrengthBound whole = strength_bound(run.model(), run.state(), {}, 1.0 / 128.0, 64.0);
    EXPECT_EQ(strength_bound_without_corners(run.model(), run.state(), {}, 1.0 / 128.0, whole).factor, whole.factor);
}

/// The middle of three pads is a tenth of a millimetre lower: a quarter of the slab lies over it.
TEST(ForcePoints, KnowWhatCohesionIsThatOfOpenJoints)
{
    const std::string pads = R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = 30.0
cohesion = 1e5
[contact]
method = "force"
[[block]]
name = "left"
polygon = [[-1, -1], [1.5, -1], [1.5, 0], [-1, 0]]
fixed = true
[[block]]
name = "low"
polygon = [[1.5, -1], [2.5, -1], [2.5, -0.0001], [1.5, -0.0001]]
fixed = true
[[block]]
name = "right"
polygon = [[2.5, -1], [5, -1], [5, 0], [2.5, 0]]
fixed = true
[[block]]
name = "slab"
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[stage]]
cycles = 1000
)";
    test::CaseRun run(read_case_text(pads, "case.toml").def);
    run.advance(1000);
    const std::vector<Index> slab{run.model().user_number[run.slot("slab")]};
    EXPECT_NEAR(open_share_of_cohesion(run.model(), run.state(), slab), 0.25, 1e-9);
    EXPECT_EQ(open_share_of_cohesion(run.model(), run.state(), {}), 0.0);
}

TEST(StrengthBound, LoadsCount)
{
    const double weight = 4.0 * 2700.0 * 9.81, a = std::acos(-1.0) / 9.0;
    const StrengthBound pressed = bound_of(slab("friction_angle_deg = 30.0\n", R"(
[[load]]
blocks = ["slab"]
force = [0.0, -5e4]
)"));
    const double expected = tan_deg(30.0) * (weight * std::cos(a) + 5e4) / (weight * std::sin(a));
    EXPECT_NEAR(pressed.factor, expected, 2e-4 * expected);
}

/// A slab of weight W on a slope of 20 degrees, phi 30 degrees, with bolts that bear `across` at right angles to the joint and `along` along it; tan phi is divided by F, what
/// the bolts bear is not.
double factor_with(double along, double across)
{
    const double weight = 4.0 * 2700.0 * 9.81, a = std::acos(-1.0) / 9.0;
    return tan_deg(30.0) * (weight * std::cos(a) + across) / (weight * std::sin(a) - along);
}

TEST(StrengthBound, BoltsBearUpToTheirStrength)
{
    const std::string slope = slab("friction_angle_deg = 30.0\n");
    const auto with = [&](const std::string& bolt)
    { return bound_of(slope + "[[bolt]]\nfrom = [2.0, 0.5]\nto = [2.0, -0.9]\n" + bolt); };
    const double tension = factor_with(0.0, 4e4);
    EXPECT_NEAR(with("stiffness = 1e5\npretension = 1e3\nyield = 4e4\n").factor, tension, 1e-3);
    EXPECT_NEAR(with("kind = \"grouted\"\narea = 1e-4\nbond_stiffness = 1e7\nbond_strength = 8e4\nyield = 1e6\n").factor, tension,
                1e-3)
        << "0.5 m of bond in the slab";
    EXPECT_NEAR(with("kind = \"grouted\"\narea = 1e-4\nbond_stiffness = 1e7\nbond_strength = 8e4\nyield = 2e4\n").factor,
                factor_with(0.0, 2e4), 1e-3);
    EXPECT_NEAR(
        with("kind = \"local\"\nstiffness = 0.0\nshear_stiffness = 1e6\nshear_strength = 1e4\nactive_length = 0.05\nyield = 1.0\n")
            .factor,
        factor_with(1e4, 0.0), 1e-3);
    EXPECT_EQ(with("stiffness = 1e5\n").end, StrengthBound::End::none) << "no strength is given";
}

TEST(StrengthBound, JointsThatKeepTheirStrengthHold)
{
    EXPECT_EQ(bound_of(slab("friction_angle_deg = 30.0\n"), {0}).end, StrengthBound::End::none);
    EXPECT_EQ(bound_of(slab("friction_angle_deg = 10.0\n"), {0}).end, StrengthBound::End::no_balance);
    const StrengthBound low = bound_of(slab("friction_angle_deg = 10.0\n"));
    EXPECT_NEAR(low.factor, tan_deg(10.0) / tan_deg(20.0), 1e-3);
}
}  // namespace
}  // namespace hdem
