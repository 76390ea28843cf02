#include "io/case_reader.h"
#include "verification/unit/io/case_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

namespace hdem
{
namespace
{
using test::two_blocks;
using test::with;

/// All that a case is warned of.
std::string warnings(const std::string& text)
{
    std::string texts;
    for (const Problem& warning : read_case_text(text, "case.toml").warnings)
        texts += warning.text + '\n';
    return texts;
}

TEST(CaseWarnings, WarnsAboutSettingsWithoutEffect)
{
    const CaseFile file = read_case_text(
        two_blocks + "[time]\nstep = 1e-4\nfraction = 0.1\n[damping]\npreset = \"dynamic\"\nlocal = 0.5\n", "case.toml");
    ASSERT_EQ(file.warnings.size(), 2U);
    EXPECT_EQ(file.warnings[0].text,
              "case.toml:18:12: warning: [time]: fraction (has no effect: step is given). Remove one of the two.");
    EXPECT_THAT(file.warnings[1].text, testing::HasSubstr("case.toml:21:9: warning: [damping]: local"));
}

TEST(CaseWarnings, WarnsOfAsperitiesThatAreSteeperThanTheirFriction)
{
    const auto of_friction = [](double friction)
    {
        const std::string joint = "[joint.j]\nmaterials = [\"rock\", \"rock\"]\nlaw = \"plesha\"\nnormal_stiffness = "
                                  "1e9\nshear_stiffness = 1e10\nasperity_angle_deg = 20\n";
        return warnings(two_blocks + joint + fmt::format("friction_angle_deg = {}\n", friction));
    };
    EXPECT_EQ(of_friction(20.0), "");
    EXPECT_THAT(of_friction(10.0), testing::HasSubstr("case.toml:21:22: warning: joint \"j\": asperity_angle_deg = 20 (is above "
                                                      "friction_angle_deg = 10: "));
    EXPECT_THAT(of_friction(10.0), testing::HasSubstr("Give no more than the friction angle"));
}

TEST(CaseWarnings, WarnsOfNumbersThatAreMeantInAnotherUnit)
{
    const std::string bolt = two_blocks + "[[bolt]]\nfrom = [0.5, 0.5]\nto = [0.5, -0.5]\n";
    const std::string stress = two_blocks + "[insitu]\n", water = two_blocks + "[water]\nlevel = 0\n";
    const std::string side = two_blocks + "[domain]\nwidth = 5\nheight = 5\norigin = [20, 20]\n[[boundary]]\nside = \"top\"\n";
    const std::string grouted = bolt + "kind = \"grouted\"\narea = 4.9e-4\n";
    struct Slip
    {
        std::string text, says;
    };
    const Slip slips[] = {
        {with(two_blocks, "2700.0", "2.7"),
         "2:11: warning: material \"rock\": density = 2.7 (rock has 1500 to 3500 kg/m3). Give it in"},
        {with(two_blocks, "2700.0", "2.7e6"), "density = 2.7e+06 (rock has"},
        {with(two_blocks, "= 30.0", "= 0.52"), "6:22: warning: joint \"default\": friction_angle_deg = 0.52 (hardly any friction"},
        {with(two_blocks, "7e9", "7"),
         "4:20: warning: joint \"default\": normal_stiffness = 7 (so soft that the weight of a block presses it "
         "into the next one by 3.8e+03 of its height). Give it in Pa/m: at least 3e+07,"},
        {with(two_blocks, "7e9", "2.6e7"), "by 0.001 of its height"},
        {bolt + "area = 380\n", "19:8: warning: bolt \"bolt1\": area = 380 (a bar with a diameter of 22 m). Give it in m2"},
        {bolt + "area = 4.9e-4\nmodulus = 200\n", "modulus = 200 (steel has 2e11 Pa"},
        {bolt + "area = 4.9e-4\nyield = 200\n", "yield = 200 (a stress of 0.41 MPa in the bar). Give the force in N"},
        {with(two_blocks, "friction_angle_deg = 30.0",
              "law = \"barton_bandis\"\njrc = 9\njcs = 100\nlength = 1\nnormal_stress = 1e6\nresidual_friction_angle_deg = 30.0"),
         "jcs = 100 (walls of joints have 1e7 to 3e8 Pa). Give it in Pa"},
        {two_blocks + "[[liner]]\npath = [[0, 0], [1, 0]]\nthickness = 0.2\nmodulus = 25\nnormal_stiffness = 1e10\n",
         "liner \"liner1\": modulus = 25 (concrete has"},
        {stress + "stress = [-1e6, -2e6, 0]\n" + "[domain]\nwidth = 5\nheight = 5\norigin = [20, 20]\n" +
             "[[boundary]]\nside = \"top\"\nkind = \"stress\"\nstress = [-2e6, 0]\n",
         "boundary \"boundary1\": stress = [-2e+06, 0] (it pulls at the rock). Compression is positive here"},
        {side + "kind = \"stress\"\nstress = [-1, 0]\n", "stress = [-1, 0] (it pulls at the rock)"},
        {side + "kind = \"stress\"\nstress = [5, 0]\n", "stress = [5, 0] (less than a centimetre of rock weighs). Give it in Pa"},
        {side + "kind = \"servo\"\ntarget = 2\n", "target = 2 (less than"},
        {two_blocks + "[[liner]]\npath = [[0, 0], [1, 0]]\nthickness = 0.2\nmodulus = 25e9\nnormal_stiffness = 1e10\n"
                      "compressive_strength = 30\n",
         "compressive_strength = 30 (shotcrete has"},
        {grouted + "bond_stiffness = 10\nbond_strength = 3e5\n", "bond_stiffness = 10 (grout has"},
        {grouted + "bond_stiffness = 1e9\nbond_strength = 300\n", "bond_strength = 300 (grout has"},
        {with(water, "level = 0", "level = 1e6"), "17:9: warning: [water]: level = 1e+06 (more than a kilometre above"},
        {with(water, "level = 0", "level = -100"), "level = -100 (all rock lies above it"},
        {stress + "stress = [1e6, 2e6, 0]\n", "17:10: warning: [insitu]: stress = [1e+06, 2e+06, 0] (tension in all directions"},
        {stress + "surface = -150\nratio = 0.7\n", "17:11: warning: [insitu]: surface = -150 (all rock lies above it"},
        {stress + "surface = 150\nratio = 70\n", "18:9: warning: [insitu]: ratio = 70 ("},
        {water + "density = 1\n", "18:11: warning: [water]: density = 1 (water has 1000 kg/m3). Give it in kg/m3"}};
    for (const Slip& slip : slips)
        EXPECT_THAT(warnings(slip.text), testing::HasSubstr(slip.says));
    const std::string meant[] = {two_blocks,
                                 with(two_blocks, "2700.0", "7850"),
                                 with(two_blocks, "7e9", "3e7"),
                                 with(two_blocks, "= 30.0", "= 0"),
                                 with(two_blocks, "= 30.0", "= 2"),
                                 bolt + "area = 4.9e-4\nyield = 2e5\n",
                                 stress + "stress = [-1e6, 1e5, 0]\n",
                                 stress + "surface = 150\nratio = 3\n",
                                 side + "kind = \"stress\"\nstress = [1e6, 0]\n",
                                 grouted + "bond_stiffness = 1e9\nbond_strength = 3e5\n",
                                 with(water, "level = 0", "level = 400"),
                                 water + "density = 1030\n"};
    for (const std::string& text : meant)
        EXPECT_EQ(warnings(text), "") << text;
}

TEST(CaseWarnings, WarnsOfASetThatIsThereAlready)
{
    const std::string rock = two_blocks + "[domain]\nwidth = 5\nheight = 5\norigin = [20, 20]\n", set = "[[joint_set]]\ndip_deg = ";
    const std::string first = rock + set + "-60\nspacing = 1\n" + set;
    EXPECT_THAT(
        warnings(first + "120\nspacing = 1\n"),
        testing::HasSubstr("joint set \"set2\": dip_deg, spacing and origin (are those of \"set1\": its joints are cut already)"));
    for (const char* other : {"60\nspacing = 1\n", "-60\nspacing = 1.5\n", "-60\nspacing = 1\norigin = [21, 20.5]\n",
                              "-60\nspacing = 1\npersistence = 0.5\n", "-60\nspacing = 1\ndeviation_deg = 2\n"})
        EXPECT_EQ(warnings(first + other), "") << other;
}

TEST(CaseWarnings, WarnsOfAStaticSolutionThatIsNotSought)
{
    const std::string rest = with(two_blocks, "cycles = 10", "until = \"converged\"\nsolver = \"static\"");
    const std::string load = "[[load]]\nblocks = [\"top\"]\nforce = [1, 0]\n",
                      said = "a static solution needs gravity and the default";
    EXPECT_EQ(warnings(rest), "");
    for (const std::string& more :
         {load, std::string("[contact]\nmethod = \"impulse\"\n"), std::string("[damping]\npreset = \"paper\"\n")})
        EXPECT_THAT(warnings(rest + more), testing::HasSubstr(said)) << more;
}

/// Local damping lets a weight that acts at once press up to a third more than it weighs.
TEST(CaseWarnings, WarnsOfJointsThatAWeightBreaksThatActsAtOnce)
{
    const std::string rest = with(two_blocks, "cycles = 10", "until = \"converged\"");
    const auto joint = [&](const std::string& keys) { return with(rest, "= 30.0\n", "= 30.0\n" + keys); };
    EXPECT_THAT(
        warnings(joint("cohesion = 1e5\ntension = 3e4\n")),
        testing::HasSubstr("warning: joint \"default\": tension (breaks for good, and stage \"stage1\" begins with rock without "
                           "stress: the weight that acts at once is felt up to 1.33 times until the rock is at rest). Let "
                           "the weight grow: relax_cycles = 5000 in that stage; or give [insitu]."));
    EXPECT_THAT(warnings(joint("cohesion = 3e4\nresidual_cohesion = 0\n")),
                testing::HasSubstr("residual_cohesion (breaks for good"));
    EXPECT_EQ(warnings(joint("cohesion = 3e4\n")), "");
    EXPECT_EQ(warnings(joint("cohesion = 1e5\ntension = 3e4\n") + "set = [\"joint.default.cohesion=1e9\"]\n"), "");
    EXPECT_EQ(warnings(joint("cohesion = 1e5\ntension = 3e4\n") + "relax_cycles = 100\n"), "");
    EXPECT_EQ(warnings(joint("cohesion = 1e5\ntension = 3e4\n") + "[insitu]\nstress = [-1e6, -1e6, 0]\n"), "");
    EXPECT_EQ(warnings(joint("cohesion = 1e5\ntension = 3e4\n") + "[gravity]\nvector = [0, 0]\n"), "");
    EXPECT_EQ(warnings(with(two_blocks, "= 30.0\n", "= 30.0\ncohesion = 1e5\ntension = 3e4\n")), "");
}

/// In the first swings the ratio of shear to normal force is not that of rest, at however small a weight.
TEST(CaseWarnings, WarnsOfResidualFrictionThatBeginsWithoutStress)
{
    const std::string rest = with(two_blocks, "cycles = 10", "until = \"converged\"");
    const auto joint = [&](const std::string& keys) { return with(rest, "= 30.0\n", "= 30.0\n" + keys); };
    const std::string lower = joint("residual_friction_angle_deg = 20\n");
    for (const char* more : {"", "relax_cycles = 5000\n"})
        EXPECT_THAT(warnings(lower + more),
                    testing::HasSubstr("joint \"default\": residual_friction_angle_deg (holds for good where a point slips"));
    EXPECT_EQ(warnings(joint("residual_friction_angle_deg = 30\n")), "");
    EXPECT_EQ(warnings(joint("residual_friction_angle_deg = 20\ncohesion = 1e4\n")), "");
    EXPECT_EQ(warnings(lower + "[insitu]\nstress = [-1e6, -1e6, 0]\n"), "");
    EXPECT_EQ(warnings(with(two_blocks, "= 30.0\n", "= 30.0\nresidual_friction_angle_deg = 20\n")), "") << "a stage of cycles";
    const std::string later = "[[stage]]\nset = [\"joint.default.residual_friction_angle_deg=20\"]\nuntil = \"converged\"\n";
    EXPECT_EQ(warnings(joint("residual_friction_angle_deg = 30\n") + later), "");
}

TEST(CaseWarnings, WarnsAboutAShareOfTheStableStepThatNoStageTakes)
{
    const auto warnings = [](const std::string& stage, const std::string& more = "")
    {
        std::string texts;
        const std::string text = test::with(two_blocks, "cycles = 10\n", stage + "\n");
        for (const Problem& warning : read_case_text(text + "[time]\nstable_fraction = 0.5\n" + more, "case.toml").warnings)
            texts += warning.text;
        return texts;
    };
    const std::string until = "until = \"converged\"", timed = "cycles = 10";
    const auto says = [](const char* why)
    { return testing::HasSubstr(std::string("warning: [time]: stable_fraction (has no effect: ") + why); };
    EXPECT_EQ(warnings(until), "");
    EXPECT_EQ(warnings(until + "\ndamping = \"default\"", "[damping]\npreset = \"paper\"\n"), "");
    EXPECT_THAT(warnings(until, "step = 1e-4\n"), says("step is given"));
    EXPECT_EQ(warnings(until, "[[load]]\nblocks = [\"top\"]\nforce = [1, 0]\n"), "");
    EXPECT_THAT(warnings(until, "[[block]]\npolygon = [[5, 5], [6, 5], [6, 6]]\nfixed = true\nvelocity = [1, 0]\n"),
                says("with prescribed motions"));
    EXPECT_THAT(warnings(timed), says("no stage runs until converged"));
    EXPECT_THAT(warnings(until, "[damping]\npreset = \"paper\"\n"), says("no stage runs until converged"));
}

/// A name alone does nothing: contacts would silently have the default.
TEST(CaseWarnings, WarnsOfJointsThatNothingNames)
{
    const std::string joint = "[joint.bedding]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_angle_deg = 20\n";
    const auto warnings = [&](const std::string& more)
    {
        std::string texts;
        for (const Problem& warning : read_case_text(two_blocks + more, "case.toml").warnings)
            texts += warning.text;
        return texts;
    };
    const std::string domain = "[domain]\norigin = [10, 0]\nwidth = 4\nheight = 4\n";
    const std::string set = "[[joint_set]]\nname = \"bedding\"\ndip_deg = 10\nspacing = 1\n";
    EXPECT_THAT(warnings(domain + set + joint),
                testing::HasSubstr("case.toml:24:1: warning: joint \"bedding\": [joint.bedding] (no "
                                   "contact has it: nothing names it). Give joint = \"bedding\" to"));
    EXPECT_EQ(warnings(domain + set + "joint = \"bedding\"\n" + joint), "");
    EXPECT_EQ(warnings(joint + "materials = [\"rock\", \"rock\"]\n"), "");
    EXPECT_EQ(warnings(domain + "[voronoi]\nedge = 1\njoint = \"bedding\"\n" + joint), "");
    EXPECT_EQ(warnings(domain + "[[fault]]\nname = \"f\"\npoints = [[9, 1], [15, 2]]\njoint = \"bedding\"\n" + joint), "");
}

TEST(CaseWarnings, WarnsOfForcesOnFixedBlocks)
{
    const auto warnings = [](const std::string& more)
    {
        std::string texts;
        for (const Problem& warning : read_case_text(two_blocks + more, "case.toml").warnings)
            texts += warning.text;
        return texts;
    };
    const std::string block = "[[block]]\nname = \"last\"\npolygon = [[20, 0], [21, 0], [21, 1], [20, 1]]\n";
    const std::string load = "fixed = true\n[[load]]\nblocks = [\"last\"]\n";
    EXPECT_THAT(warnings(block + load + "force = [1e5, 0]\n"),
                testing::HasSubstr("load \"load1\": blocks names \"last\" (does not move it: it is fixed in all stages). Name"));
    EXPECT_EQ(warnings(block + load + "velocity_x = 0.1\n"), "");
    const std::string freed = "[[stage]]\nname = \"go\"\ncycles = 10\nfree = [\"last\"]\n";
    EXPECT_EQ(warnings(block + load + "force = [1e5, 0]\n" + freed), "");
}

TEST(CaseWarnings, WarnsOfASolverOfAStageThatDoesNotLookForRest)
{
    const auto warnings = [](const std::string& end)
    {
        std::string texts;
        for (const Problem& warning :
             read_case_text(test::with(two_blocks, "cycles = 10", end + "\nsolver = \"static\""), "case.toml").warnings)
            texts += warning.text;
        return texts;
    };
    EXPECT_EQ(warnings("until = \"converged\""), "");
    for (const char* end : {"cycles = 10", "duration = 0.1", "until = \"speed < 1e-3\""})
        EXPECT_THAT(warnings(end), testing::HasSubstr("stage \"stage1\": solver (has no effect: the stage does not look for rest)"))
            << end;
}
}  // namespace
}  // namespace hdem
