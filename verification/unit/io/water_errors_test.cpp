#include "core/rock/build_model.h"
#include "io/pressure_table.h"
#include "verification/unit/io/case_text.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace hdem
{
namespace
{
using test::problems_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// Lines 1 to 12; tests add theirs from line 13 on.
const std::string head = R"([material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[domain]
width = 4.0
height = 4.0
[[stage]]
name = "stand"
cycles = 10
)";

void expect_one_problem(const std::string& text, const std::string& place_and_object, const std::string& says)
{
    EXPECT_THAT(problems_of(head + text), ElementsAre(testing::AllOf(StartsWith("case.toml:" + place_and_object), HasSubstr(says))))
        << text;
}

TEST(WaterErrors, TellWhatIsWrongAndWhatToDo)
{
    expect_one_problem("water_level = 3.0\n", "13:15: stage \"stand\": water_level", "there is no [water]");
    expect_one_problem("[water]\nlevel = 3.0\ntable = [[0, 3], [4, 2]]\n", "15:9: [water]: table", "contradicts level");
    expect_one_problem("[water]\nlevel = 3.0\njoints = [\"bed\"]\n", "15:10: [water]", "bed");
    expect_one_problem("[water]\nlevel = 3.0\nflooded = [\"shaft\"]\n", "15:11: [water]", "shaft");
    expect_one_problem("[water]\nlevel = 3.0\ndensity = 0.0\n", "15:11: [water]: density", "> 0");
    expect_one_problem("[water]\nlevel = 3.0\n[gravity]\nvector = [0.0, 0.0]\n", "13:1: [water]: gravity", "no weight");
    expect_one_problem("[[water_crack]]\ncrack = [[2, 4], [2, 1]]\noutlet = [[2, 1], [0, 0]]\nlevel = 3.0\n", "13:1: water crack 1",
                       "there is no [water]");
    const auto warnings = read_case_text(head + "[water]\nponded = false\n", "case.toml").warnings;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0].text, HasSubstr("[water]: level (is missing"));
    const auto dry = read_case_text(head + "[[excavation]]\nname = \"shaft\"\nshape = \"circle\"\nposition = [2, 2]\ndiameter = 1\n"
                                           "[water]\nlevel = 3.0\nponded = false\nflooded = [\"shaft\"]\n",
                                    "case.toml")
                         .warnings;
    EXPECT_TRUE(std::ranges::any_of(dry, [](const Problem& warning)
                                    { return warning.text.find("no effect with ponded = false") != std::string::npos; }));
    const std::string crack = "[water]\n[[water_crack]]\nlevel = 3.0\ncrack = [[2, 4], [2, 1]]\n";
    expect_one_problem(crack + "outlet = [[2, 2], [0, 0]]\n", "17:10: water crack 1: outlet", "ends at [2, 1]");
    expect_one_problem(crack + "outlet = [[2, 1], [2, 1], [0, 0]]\n", "17:10: water crack 1: outlet", "twice");
    expect_one_problem(crack + "outlet = [[2, 1]]\n", "17:10: water crack 1: outlet", "at least 2");
    expect_one_problem("[water]\npressure = \"none.csv\"\n", "14:12: [water]: pressure", "none.csv");
    // Pressures that are given need no weight.
    expect_one_problem("[water]\npressure = \"none.csv\"\n[gravity]\nvector = [0.0, 0.0]\n", "14:12: [water]: pressure",
                       "none.csv");
}

/// Pressures of a file stay as they are: a level given by a stage would be forgotten.
TEST(WaterErrors, TellOfLevelsOfStagesBesideAFileOfPressures)
{
    for (const char* given : {"water_level = 3.0\n", "water_table = [[0, 3], [4, 2]]\n"})
        EXPECT_THAT(
            problems_of(head + given + "[water]\npressure = \"none.csv\"\n"),
            testing::Contains(AllOf(HasSubstr("case.toml:13:"), HasSubstr("stage \"stand\": water_"),
                                    HasSubstr("has no effect: water.pressure gives the pressure). Remove one of the two."))))
            << given;
}

/// relax_cycles: the change of the water comes evenly; it needs no excavation.
TEST(WaterErrors, ALevelMayComeSlowlyWithoutAnExcavation)
{
    const std::string slow = "relax_cycles = 5\n", water = "[water]\nlevel = 3.0\n";
    EXPECT_THAT(problems_of(head + "water_level = 1.0\n" + slow + water), testing::IsEmpty());
    EXPECT_THAT(problems_of(head + "water_table = [[0, 3], [4, 2]]\n" + slow + "[water]\ntable = [[0, 1], [4, 2]]\n"),
                testing::IsEmpty());
    expect_one_problem(slow + water + "[insitu]\nsurface = 4.0\nratio = 1.0\n", "13:16: stage \"stand\": relax_cycles = 5",
                       "no water changes");
}

/// Water that would be missing silently.
TEST(WaterErrors, TellOfCracksThatPressOnNothing)
{
    const auto warnings = [](const std::string& crack, const std::string& outlet, const std::string& level)
    {
        const std::string joints = "[[joint_set]]\ndip_deg = 0.0\nspacing = 9.0\norigin = [2, 1]\n"
                                   "[[joint_set]]\ndip_deg = 90.0\nspacing = 9.0\norigin = [2, 1]\n";
        const CaseDef def = test::read(head + joints + "[water]\n[[water_crack]]\ncrack = " + crack + "\noutlet = " + outlet +
                                       "\nlevel = " + level + "\n");
        std::vector<std::string> texts;
        for (const Problem& problem : build_model(def).warnings)
            texts.push_back(problem.text);
        return texts;
    };
    const std::string good = "[[2, 4], [2, 1]]";
    EXPECT_THAT(warnings(good, "[[2, 1], [0, 1]]", "3.0"), testing::IsEmpty());
    // Above its water a crack may go where it likes.
    EXPECT_THAT(warnings("[[9, 9], [2, 3], [2, 1]]", "[[2, 1], [0, 1]]", "3.0"), testing::IsEmpty());
    EXPECT_THAT(
        warnings("[[1.9, 4], [1.9, 1]]", "[[1.9, 1], [0, 1]]", "3.0"),
        ElementsAre(AllOf(StartsWith("water crack 1: crack from (1.9, 1) to (1.9, 3) m"), HasSubstr("presses on nothing"))));
    EXPECT_THAT(warnings(good, "[[2, 1], [0, 0.9]]", "3.0"),
                ElementsAre(StartsWith("water crack 1: outlet from (2, 1) to (0, 0.9)")));
    EXPECT_THAT(warnings(good, "[[2, 1], [0, 1]]", "0.5"), ElementsAre(StartsWith("water crack 1: level = 0.5 m")));
}

TEST(WaterErrors, ATableRunsFromLeftToRight)
{
    const CaseDef def = test::read(head + "[water]\ntable = [[4, 3], [0, 2]]\n");
    try
    {
        static_cast<void>(build_model(def));
        ADD_FAILURE();
    }
    catch (const InputError& error)
    {
        EXPECT_THAT(error.problems().front().text, HasSubstr("lies behind the one before it"));
    }
}

TEST(WaterErrors, OfAFileOfPressuresNameItsLine)
{
    const auto problems = [](const std::string& text)
    {
        std::istringstream in(text);
        std::vector<std::string> texts;
        for (const Problem& problem : read_pressures(in, "p.csv").problems)
            texts.push_back(problem.text);
        return texts;
    };
    const std::string good = "x,y,pressure\n0,0,1e5\n4,0,1e5\n# top\n0,4,0\n";
    EXPECT_THAT(problems(good), testing::IsEmpty());
    EXPECT_THAT(problems(good + "1,2\n"), ElementsAre(AllOf(StartsWith("p.csv:6:"), HasSubstr("three finite numbers"))));
    EXPECT_THAT(problems(good + "1,2,nan\n"), ElementsAre(HasSubstr("three finite numbers")));
    EXPECT_THAT(problems(good + "1,2,-5\n"), ElementsAre(HasSubstr("suction")));
    EXPECT_THAT(problems(good + "4,0,7\n"), ElementsAre(HasSubstr("occurs twice")));
    EXPECT_THAT(problems("x,y,pressure [Pa]\n0,0,1e5\n4,0,1e5\n0,4,0\n"), testing::IsEmpty());
    for (const char* heading : {"x,y,head", "y,x,pressure", "x,y,pressure [kPa]", "x,y"})
        EXPECT_THAT(problems(heading + std::string("\n0,0,10\n4,0,10\n0,4,0\n")),
                    ElementsAre(StartsWith("p.csv:1: pressures: line (expected the heading x,y,pressure or three finite numbers")))
            << heading;
    EXPECT_THAT(problems("0,0,1\n1,0,1\n"), ElementsAre(HasSubstr("three at least")));
    EXPECT_THAT(problems(good + "1,1e9,5\n"), ElementsAre(AllOf(StartsWith("p.csv:6:"), HasSubstr("farther than"))));
    EXPECT_THAT(problems(good + std::string(3'000'000, '0')), ElementsAre(HasSubstr("line is longer")));
    std::string rows;
    for (int i = 0; i < 100'000; ++i)
        rows += std::to_string(i % 1000) + "," + std::to_string(i / 1000) + ",1\n";
    EXPECT_THAT(problems(rows), testing::IsEmpty());
    EXPECT_THAT(problems(rows + "-1,0,1\n"), ElementsAre(AllOf(StartsWith("p.csv:100001:"), HasSubstr("more than 100000 rows"))));
}

TEST(WaterPressures, AreReadBesideTheCaseAndFromWhatIsStored)
{
    const test::ScratchFolder folder("pressures");
    const std::string text = head + "[water]\npressure = \"p.csv\"\n";
    std::ofstream(folder / "p.csv") << "0,0,1e5\n4,0,1e5\n0,4,0\n";
    const CaseFile read = read_case_text(text, folder / "case.toml");
    ASSERT_EQ(read.def.water.pressures.size(), 3U);
    EXPECT_EQ(read.def.water.pressures[1], (std::array{4.0, 0.0, 1e5}));
    ASSERT_EQ(read.files.count("p.csv"), 1U) << "a checkpoint takes it along";
    std::ofstream(folder / "p.csv") << "0,0,1e5\n4,0,-1\n0,4,0\n";
    EXPECT_EQ(read_case_text(text, folder / "case.toml", {}, &read.files).def.water.pressures, read.def.water.pressures);
    try
    {
        static_cast<void>(read_case_text(text, folder / "case.toml"));
        ADD_FAILURE();
    }
    catch (const InputError& error)
    {
        EXPECT_THAT(error.problems().front().text, AllOf(HasSubstr("p.csv:2: pressures: line"), HasSubstr("suction")));
    }
}
}  // namespace
}  // namespace hdem
