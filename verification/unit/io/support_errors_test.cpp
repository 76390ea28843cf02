#include "core/rock/build_model.h"
#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::problems_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// Lines 1 to 13; tests add theirs from line 14 on.
const std::string head = R"([material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[domain]
width = 4.0
height = 4.0
fixed = ["bottom"]
[[stage]]
name = "stand"
cycles = 10
)";
const std::string anchored = "[[bolt]]\nfrom = [1.0, 1.0]\nto = [1.0, 3.0]\n";

void expect_one_problem(const std::string& text, const std::string& place_and_object, const std::string& says)
{
    EXPECT_THAT(problems_of(head + text), ElementsAre(testing::AllOf(StartsWith("case.toml:" + place_and_object), HasSubstr(says))))
        << text;
}

TEST(SupportErrors, TellWhatIsWrongAndWhatToDo)
{
    expect_one_problem(anchored, "14:1: bolt \"bolt1\": area", "stiffness too");
    expect_one_problem(anchored + "area = 1e-4\nstage = \"dig\"\n", "18:9: bolt \"bolt1\": stage", "no stage has this name");
    expect_one_problem(anchored + "area = 1e-4\nplate = true\n", "18:9: bolt \"bolt1\": plate", "does not belong to kind anchored");
    expect_one_problem(anchored + "area = 1e-4\nyield = 1e4\npretension = 2e4\n", "19:14: bolt \"bolt1\": pretension",
                       "above yield");
    expect_one_problem(anchored + "area = 1e-4\npretension = 1e5\nrupture_strain = 0.004\n", "18:14: bolt \"bolt1\": pretension",
                       "strains the bar by 0.005");
    expect_one_problem("[[bolt]]\nfrom = [1.0, 1.0]\narea = 1e-4\n", "14:1: bolt \"bolt1\": to", "is missing");
    expect_one_problem("[[bolt]]\naround = \"shaft\"\nlength = 2.0\nalong = 1.0\narea = 1e-4\n", "15:10: bolt \"bolt1\": around",
                       "shaft");
    expect_one_problem("[[bolt]]\nkind = \"local\"\nfrom = [1.0, 1.0]\nto = [1.0, 3.0]\nstiffness = 1e8\nactive_length = 0.05\n",
                       "14:1: bolt \"bolt1\": shear_stiffness", "is missing");
}

TEST(SupportErrors, TellOfKeysThatDoNotFitTogether)
{
    const std::string liner = "[[liner]]\nthickness = 0.1\nmodulus = 25e9\nnormal_stiffness = 1e9\n";
    expect_one_problem(anchored + "area = 1e-4\nfree_length = 0.0\n", "18:15: bolt \"bolt1\": free_length",
                       "a bolt that does not stretch has no force");
    expect_one_problem(anchored + "stiffness = 0.0\n", "17:13: bolt \"bolt1\": stiffness", "the bolt would do nothing");
    expect_one_problem(anchored + "area = 1e-4\nalong = 1.0\n", "18:9: bolt \"bolt1\": along", "belongs to a pattern");
    expect_one_problem("[[bolt]]\nfrom = [1.0, 1.0]\nto = [1.0, 1.0]\narea = 1e-4\n", "16:6: bolt \"bolt1\": to",
                       "is the same point as from");
    expect_one_problem(liner + "path = [[0.0, 4.0]]\n", "18:8: liner \"liner1\": path", "has 1 points, a line has at least 2");
    expect_one_problem(liner + "path = [[0.0, 4.0], [4.0, 4.0]]\nhardening = []\n", "19:13: liner \"liner1\": hardening",
                       "has 0 points, a line has at least 2");
}

/// Static solutions leave bolts and linings out: where they are asked for, that is said.
TEST(SupportErrors, TellThatStaticSolutionsDoNotKnowSupport)
{
    std::string text = head + anchored + "area = 1e-4\n";
    text.replace(text.find("cycles = 10"), 11, "until = \"converged\"\nsolver = \"static\"");
    const auto warnings = read_case_text(text, "case.toml").warnings;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0].text,
                AllOf(StartsWith("case.toml:14:10: warning: stage \"stand\": solver = \"static\""),
                      HasSubstr("has no effect: static solutions do not know bolts and liners). Remove this key.")));
}

/// Names of bolts and linings follow the rules of all names: histories and results call them so.
TEST(SupportErrors, TellOfNames)
{
    const std::string
        liner = "[[liner]]\npath = [[0.0, 4.0], [4.0, 4.0]]\nthickness = 0.1\nmodulus = 25e9\nnormal_stiffness = 1e9\n";
    expect_one_problem(anchored + "area = 1e-4\nname = \"a/b\"\n", "18:8: bolt 1: name = \"a/b\"", "cannot be a name");
    expect_one_problem(anchored + "area = 1e-4\nname = \"\"\n", "18:8: bolt 1: name = \"\"", "cannot be a name");
    expect_one_problem(anchored + "area = 1e-4\nname = \"a\"\n" + anchored + "area = 1e-4\nname = \"a\"\n",
                       "23:8: bolt 2: name = \"a\"", "bolt 1 has this name already");
    expect_one_problem(liner + "name = \" a\"\n", "19:8: liner 1: name = \" a\"", "cannot be a name");
    expect_one_problem(liner + "name = \"a\"\n" + liner + "name = \"a\"\n", "25:8: liner 2: name = \"a\"",
                       "liner 1 has this name already");
}

TEST(SupportErrors, TellWhatIsWrongWithALiner)
{
    const std::string beam = "thickness = 0.1\nmodulus = 25e9\nnormal_stiffness = 1e9\n";
    expect_one_problem("[[liner]]\n" + beam, "14:1: liner \"liner1\": around, path", "none is given");
    expect_one_problem("[[liner]]\npath = [[1.0, 1.0], [1.0, 1.0]]\n" + beam, "15:8: liner \"liner1\": path", "are the same");
    expect_one_problem("[[liner]]\naround = \"shaft\"\n" + beam, "15:10: liner \"liner1\": around", "shaft");
    expect_one_problem("[[liner]]\npath = [[0.0, 4.0], [4.0, 4.0]]\nhardening = [[5, 0.1], [5, 1.0]]\n" + beam,
                       "16:13: liner \"liner1\": hardening: row 2", "must grow");
    expect_one_problem("[[liner]]\npath = [[0.0, 4.0], [4.0, 4.0]]\narc = [30, 20]\n" + beam, "16:7: liner \"liner1\": arc",
                       "around");
}

/// Of build_model.
std::string first_problem(const std::string& text)
{
    try
    {
        build_model(test::read(head + text));
    }
    catch (const InputError& error)
    {
        return error.problems().size() == 1 ? error.problems().front().text : "not one problem";
    }
    return "none";
}

/// Bolts of a pattern get their names when they are made.
TEST(SupportErrors, TellOfABoltThatIsCalledAsOneOfAPattern)
{
    const std::string hole = "[[excavation]]\nname = \"hole\"\nshape = \"rectangle\"\nposition = [2, 1]\nwidth = 1\nheight = 1\n"
                             "[[joint_set]]\ndip_deg = 0\nspacing = 0.7\n";
    const std::string
        pattern = "[[bolt]]\nname = \"row\"\naround = \"hole\"\nlength = 1.5\nalong = 0.5\narc = [60, 120]\narea = 1e-4\n";
    const std::string single = "[[bolt]]\nname = \"row.1\"\nfrom = [0.5, 0.5]\nto = [0.5, 3.5]\narea = 1e-4\n";
    EXPECT_EQ(first_problem(hole + pattern), "none");
    EXPECT_THAT(first_problem(hole + pattern + single), HasSubstr("bolt \"row.1\": name (another bolt is called \"row.1\""));
    EXPECT_THAT(first_problem(hole + single + pattern), HasSubstr("bolt \"row\": name (another bolt is called \"row.1\""));
}

/// A pattern, a bolt or a liner of more pieces than the memory holds is refused before it is made.
TEST(SupportErrors, TellOfPiecesWithoutNumber)
{
    const std::string
        opening = "[[excavation]]\nname = \"shaft\"\nshape = \"rectangle\"\nposition = [2.0, 1.0]\nwidth = 1.0\nheight = 1.0\n"
                  "[[joint_set]]\ndip_deg = 0.0\nspacing = 0.7\n";
    const std::string pattern = opening + "[[bolt]]\naround = \"shaft\"\nlength = 2.0\narea = 1e-4\n";
    EXPECT_THAT(first_problem(pattern + "along = 1e-9\n"), HasSubstr("makes 4e+09 bolts"));
    EXPECT_THAT(first_problem(pattern + "along = 1e-320\n"), HasSubstr("bolts; a pattern may have"));
    EXPECT_EQ(first_problem(pattern + "along = 0.4\n"), "none");

    const std::string grouted = "kind = \"grouted\"\nbond_stiffness = 1e7\nbond_strength = 1e5\n";
    EXPECT_THAT(first_problem(pattern + grouted + "along = 0.4\nsegment = 1e-12\n"), HasSubstr("makes 2e+12 pieces of 2 m"));
    EXPECT_THAT(first_problem(pattern + grouted + "along = 1e-3\nsegment = 1e-3\n"), HasSubstr("all bolts and liners together"));
    EXPECT_THAT(first_problem(opening + anchored + "area = 1e-4\nkind = \"grouted\"\nbond_stiffness = 1e18\nbond_strength = 1e5\n"),
                HasSubstr("pieces of 2 m"));
    EXPECT_EQ(first_problem(opening + anchored + "area = 1e-4\n" + grouted + "segment = 1e-3\n"), "none");

    const std::string beam = "[[liner]]\npath = [[0.0, 4.0], [4.0, 4.0]]\nmodulus = 25e9\nnormal_stiffness = 1e9\n";
    EXPECT_THAT(first_problem(opening + beam + "thickness = 0.1\nsegment = 1e-12\n"), HasSubstr("makes 4e+12 pieces of 4 m"));
    EXPECT_THAT(first_problem(opening + beam + "thickness = 1e-9\n"), HasSubstr("pieces of 4 m"));
}

TEST(SupportErrors, TellOfEndsThatHoldNothing)
{
    const auto text_of_problem = [](const std::string& ends)
    {
        try
        {
            build_model(test::read(head + "[[bolt]]\narea = 1e-4\n" + ends));
        }
        catch (const InputError& error)
        {
            return error.problems().front().text;
        }
        return std::string("none");
    };
    EXPECT_THAT(text_of_problem("from = [1.0, 1.0]\nto = [1.0, 3.0]\n"), HasSubstr("both ends lie in block"));
    EXPECT_THAT(text_of_problem("from = [-1.0, 1.0]\nto = [1.0, 3.0]\n"), HasSubstr("lies in no block"));
    EXPECT_THAT(text_of_problem("from = [1.0, 1.0]\nto = [1.0, 5.0]\n"), HasSubstr("(1, 5)"));
    // A cable through the air in a notch of one block.
    const std::string notched = "[[block]]\npolygon = [[5, 0], [6, 0], [6, 2], [8, 2], [8, 0], [9, 0], [9, 3], [5, 3]]\n"
                                "[[block]]\npolygon = [[9, 0], [10, 0], [10, 3], [9, 3]]\n";
    EXPECT_THAT(
        text_of_problem("kind = \"grouted\"\nbond_stiffness = 1e7\nbond_strength = 1e5\nfrom = [9.5, 1.0]\nto = [5.5, 1.0]\n" +
                        notched),
        HasSubstr("from (8, 1) to (6, 1) m there is no block"));
    // A history of such a bolt is no second problem.
    const std::string sampled = "[[joint_set]]\ndip_deg = 0.0\nspacing = 9.0\norigin = [2, 3.5]\n[[history]]\nbolt = "
                                "\"bolt1\"\nquantities = [\"axial_force\"]\n";
    EXPECT_THAT(first_problem(anchored + "area = 1e-4\n" + sampled), HasSubstr("both ends lie in block"));
}
}  // namespace
}  // namespace hdem
