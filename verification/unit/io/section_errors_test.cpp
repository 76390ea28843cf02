#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::problems_of;
using testing::HasSubstr;

/// Rock of 4 m x 4 m. The tests give its domain and what stands behind it.
const std::string head = R"([material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[[stage]]
name = "stand"
cycles = 10
)";
const std::string rectangle = "[domain]\nwidth = 4.0\nheight = 4.0\nfixed = [\"bottom\"]\n";
const std::string under_profile = "[domain]\nprofile = \"topo.csv\"\nbottom = 0.0\n";

struct Mistake
{
    std::string text;
    const char* object_and_key;
    const char* says;
};

void expect_each_said(const std::vector<Mistake>& mistakes)
{
    for (const Mistake& mistake : mistakes)
        EXPECT_THAT(problems_of(head + mistake.text),
                    testing::Contains(testing::AllOf(HasSubstr(mistake.object_and_key), HasSubstr(mistake.says))))
            << mistake.text;
}

TEST(SectionErrors, TellOfKeysThatTheDomainDoesNotKnow)
{
    const std::string tunnel = "[[excavation]]\nname = \"t\"\nshape = \"rectangle\"\nposition = [2.0, 2.0]\nwidth = "
                               "1.0\nheight = 1.0\n";
    expect_each_said({
        {under_profile + "fixed = [\"top\"]\n", "[domain]: fixed = \"top\"", "is not one side: the domain ends at a profile"},
        {under_profile + "fixed = [\"bottom\"]\n[[boundary]]\nside = \"top\"\nkind = \"roller\"\n", "side = \"top\"",
         "is not one side: the domain ends at a profile"},
        {rectangle + tunnel + "arc_segments = 8\n", "excavation \"t\": arc_segments", "a rectangle has no arc). Remove it."},
        {rectangle + "[[fault]]\nname = \"f\"\njoint = \"default\"\npoints = [[0.0, 2.0], [4.0, 2.0]]\n[[region]]\nname = "
                     "\"up\"\nabove = \"f\"\nmaterial = \"rock\"\njoint = \"default\"\n",
         "region \"up\": joint", "belongs to polygon, which is not given"},
    });
}

TEST(SectionErrors, TellOfWhatAStageCannotSet)
{
    const auto later = [](const std::string& set)
    { return rectangle + "[material.clay]\ndensity = 2000.0\n[[stage]]\nname = \"later\"\ncycles = 10\nset = [" + set + "]\n"; };
    const std::string angle = "[joint.rough]\nmaterials = [\"rock\", \"clay\"]\nnormal_stiffness = 7e9\nshear_stiffness = 5e8\n"
                              "friction_angle_deg = 30.0\ndilation_angle_deg = 5.0\n";
    expect_each_said({
        {later(R"("joint.default.initially = \"broken\"")"), "set = \"joint.default.initially = ...\"",
         "contacts bear by it already"},
        {later(R"("joint.default.materials = [\"rock\", \"clay\"]")"), "set = \"joint.default.materials = ...\"",
         "contacts bear by it already"},
        {later(
             R"("joint.default.law = \"slip_weakening\"", "joint.default.residual_friction_angle_deg = 20", "joint.default.wear_length = 1")"),
         "set = \"joint.default.law = ...\"", "contacts bear by it already"},
        {later("\"joint.rough.dilation_angle_deg = 3\"") + "set_cycles = 5\n" + angle, "set = \"joint.rough: dilation_angle_deg\"",
         "only strengths change over set_cycles or a table"},
        {later("\"material.rock.density = 2600\"") + "set_cycles = 5\n", "set = \"material...\"",
         "only strengths of joints change over set_cycles or a table"},
    });
}

/// Each stage goes on from what the one before it has set.
TEST(SectionErrors, ADensityMayBeSetTwice)
{
    std::string text = head + rectangle;
    const std::pair<const char*, const char*> later[] = {{"a", "3000"}, {"b", "2000"}, {"c", "2000"}};
    for (const auto& [name, density] : later)
        text += std::string("[[stage]]\nname = \"") + name + "\"\ncycles = 10\nset = [\"material.rock.density = " + density +
                "\"]\n";
    const std::vector<StageDef> stages = test::read(text).stages;
    ASSERT_EQ(stages.size(), 4U);
    EXPECT_TRUE(stages[0].materials.empty());
    ASSERT_EQ(stages[1].materials.size(), 1U);
    EXPECT_EQ(stages[1].materials[0].density, 3000.0);
    ASSERT_EQ(stages[2].materials.size(), 1U);
    EXPECT_EQ(stages[2].materials[0].density, 2000.0);
    EXPECT_TRUE(stages[3].materials.empty()) << "nothing changes there";
}

TEST(SectionErrors, TellOfCellsWithoutADomain)
{
    expect_each_said({
        {"[[block]]\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\nfixed = true\n[voronoi]\nsize = 0.5\n", "[voronoi]: [voronoi]",
         "fills the domain only, and there is no [domain]). Give a [domain]."},
    });
}

TEST(SectionErrors, TellOfLoadsThatEndBeforeTheyBegin)
{
    const std::string load = rectangle + "[[load]]\nblocks = [\"*\"]\nacceleration = [1.0, 0.0]\n";
    expect_each_said({
        {load + "from_time = 2.0\nuntil_time = 1.0\n", "until_time = 1 s",
         "the load ends before it begins). Give more than from_time."},
        {load + "from_cycle = 5\nuntil_cycle = 5\n", "until_cycle = 5",
         "the load ends before it begins). Give more than from_cycle."},
    });
}

TEST(SectionErrors, TellOfSearchesForAFactorThatFindNothing)
{
    const std::string search = rectangle + "[factor_of_safety]\n";
    expect_each_said({
        {search + "reduce = []\n", "[factor_of_safety]: reduce = []", "weakens nothing"},
        {search + "bracket = [2.0, 1.0]\n", "bracket = [2, 1]", "its end is not above its beginning"},
        {search + "bracket = [1.0, 1.5]\ntolerance = 0.5\n", "tolerance = 0.5", "is no less than the width of the bracket"},
    });
}

TEST(SectionErrors, TellOfWaterAndHistoriesThatDoNotFit)
{
    const std::string history = rectangle + "[[history]]\nname = \"h\"\nblock = \"b1\"\n";
    expect_each_said({
        {rectangle + "[water]\nlevel = 3.0\njoints = []\n", "[water]: joints = []", "no joint would have water"},
        {history + "quantities = [\"displacement_x\", \"displacement_x\"]\n", "history \"h\": quantities", "is listed twice"},
    });
}
}  // namespace
}  // namespace hdem
