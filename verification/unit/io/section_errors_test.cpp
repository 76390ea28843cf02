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
