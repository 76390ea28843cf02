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

/// Lines 1 to 11; tests add theirs from line 12 on.
const std::string rectangle = R"([material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[[stage]]
name = "load"
cycles = 10
[domain]
width = 4.0
)";
const std::string height = "height = 4.0\n";
const std::string polygon = "polygon = [[0, 0], [4, 0], [4, 4], [0, 4]]\n";

void expect_one_problem(const std::string& text, const std::string& place_and_object, const std::string& says)
{
    EXPECT_THAT(problems_of(text), ElementsAre(testing::AllOf(StartsWith("case.toml:" + place_and_object), HasSubstr(says))))
        << text;
}

TEST(BoundaryErrors, TellWhatIsWrongAndWhatToDo)
{
    const std::string head = rectangle + height + "[[boundary]]\nname = \"lid\"\n";  // ends with line 14
    const std::string on_top = head + "side = \"top\"\n";                            // 15
    const struct
    {
        std::string text;
        const char* place_and_object;
        const char* says;
    } mistakes[] = {
        {on_top, "13:1: boundary \"lid\": kind (", "is missing"},
        {on_top + "kind = \"rolller\"\n", "16:8: boundary \"lid\": kind = \"rolller\" (", "did you mean 'roller'?"},
        {head + "side = \"up\"\nkind = \"roller\"\n", "15:8: boundary \"lid\": side = \"up\" (", "Choose from \"left\""},
        {head + "kind = \"roller\"\n", "13:1: boundary \"lid\": side (", "is missing"},
        {head + "edges = [0]\nkind = \"roller\"\n", "15:9: boundary \"lid\": edges (", "the domain is a rectangle). Use side"},
        {on_top + "kind = \"roller\"\nramp_cycles = [0, 5]\n", "17:15: boundary \"lid\": ramp_cycles (",
         "belongs to the kinds stress, velocity and servo"},
        {on_top + "kind = \"stress\"\nstress = [1e6, 0]\ntable = [[0, 1], [-1, 0]]\n",
         "18:9: boundary \"lid\": table[1] = [-1, 0] (", "Sort the rows"},
        {on_top + "kind = \"stress\"\n", "13:1: boundary \"lid\": stress (", "this kind needs it"},
        {on_top + "kind = \"roller\"\nstress_gradient = [1e4, 0]\n", "17:19: boundary \"lid\": stress_gradient (",
         "belongs to a stress of two numbers"},
        {on_top + "kind = \"stress\"\nstress = [1e6, 0]\nstress_height = 3\n", "18:17: boundary \"lid\": stress_height (",
         "belongs to stress_gradient"},
        {on_top + "kind = \"velocity\"\n", "13:1: boundary \"lid\": velocity (", "this kind needs it"},
        {on_top + "kind = \"servo\"\n", "13:1: boundary \"lid\": target (", "this kind needs it"},
        {on_top + "kind = \"servo\"\ntarget = 1e6\n[contact]\nmethod = \"impulse\"\n", "16:8: boundary \"lid\": kind = \"servo\" (",
         "stage \"load\" has method = \"impulse\", and impulses have no stiffness to steer a wall by). Use method \"hybrid\""},
        {on_top + "kind = \"servo\"\ntarget = 1e6\n[[stage]]\nname = \"throw\"\ncycles = 5\nmethod = \"impulse\"\n",
         "16:8: boundary \"lid\": kind = \"servo\" (", "stage \"throw\" has method"},
        {on_top + "kind = \"servo\"\ntarget = -1e6\n", "17:10: boundary \"lid\": target = -1000000 Pa (", "must be > 0"},
        {on_top + "kind = \"roller\"\nstress = [1e6, 0]\n", "17:10: boundary \"lid\": stress (", "belongs to another kind"},
        {on_top + "kind = \"roller\"\nmax_velocity = 1.0\n", "17:16: boundary \"lid\": max_velocity (", "belongs to kind servo"},
        {on_top + "kind = \"stress\"\nstress = \"insitu\"\n", "17:10: boundary \"lid\": stress = \"insitu\" (",
         "there is no [insitu]). Give [insitu], or stress"},
        {on_top + "kind = \"stress\"\nstress = \"in situ\"\n", "17:10: boundary \"lid\": stress = \"in situ\" (", "Choose from"},
        {on_top + "kind = \"stress\"\nstress = [1e6]\n", "17:10: boundary \"lid\": stress = [1000000] (", "has 1 numbers"},
        {on_top + "kind = \"roller\"\nstages = [\"lod\"]\n", "17:10: boundary \"lid\": stages = \"lod\" (",
         "no stage has this name; did you mean 'load'?"},
        {on_top + "kind = \"roller\"\nstages = []\n", "17:10: boundary \"lid\": stages = [] (", "it would never act"},
        {on_top + "kind = \"roller\"\n[[boundary]]\nside = \"top\"\nkind = \"fixed\"\n",
         "18:8: boundary \"boundary2\": side = \"top\" (", "boundary \"lid\" acts there in the same stage"},
        {on_top + "kind = \"roller\"\n[[boundary]]\nname = \"lid\"\nside = \"left\"\nkind = \"fixed\"\n",
         "18:8: boundary 2: name = \"lid\" (", "boundary 1 has this name already"},
        {rectangle + height + "fixed = [\"top\"]\n[[boundary]]\nside = \"top\"\nkind = \"roller\"\n",
         "15:8: boundary \"boundary1\": side = \"top\" (", "is fixed by [domain]"},
    };
    for (const auto& [text, place_and_object, says] : mistakes)
        expect_one_problem(text, place_and_object, says);
}

TEST(BoundaryErrors, LeaveServosOfStagesThatHaveSprings)
{
    const std::string servo = rectangle + height + "[[boundary]]\nname = \"lid\"\nside = \"top\"\nkind = \"servo\"\ntarget = 1e6\n";
    const std::string throws = "[[stage]]\nname = \"throw\"\ncycles = 5\nmethod = \"impulse\"\n";
    EXPECT_THAT(problems_of(servo + "[contact]\nmethod = \"force\"\n"), testing::IsEmpty());
    EXPECT_THAT(problems_of(servo + "stages = [\"load\"]\n" + throws), testing::IsEmpty()) << "it has ended by then";
}

TEST(BoundaryErrors, OfForcesThatNothingGivesToTakeOff)
{
    const std::string lid = "[[boundary]]\nside = \"top\"\nkind = \"roller\"\n";
    const std::string two = rectangle + height + "[[stage]]\nname = \"off\"\ncycles = 5\nrelax_cycles = 5\n" + lid;
    expect_one_problem(two, "16:16: stage \"off\": relax_cycles = 5 (", "nothing is excavated, no boundary ends");
    expect_one_problem(two + "stages = [\"off\"]\n", "16:16: stage \"off\": relax_cycles = 5 (", "no boundary ends");
    EXPECT_THAT(problems_of(two + "stages = [\"load\"]\n"), ElementsAre());
}

TEST(BoundaryErrors, OfEdgesOfAPolygon)
{
    const std::string domain = test::with(rectangle, "width = 4.0\n", polygon) + "[[boundary]]\nkind = \"roller\"\n";
    expect_one_problem(domain, "12:1: boundary \"boundary1\": edges (", "is missing");
    expect_one_problem(domain + "edges = [4]\n", "14:9: boundary \"boundary1\": edges = 4 (", "has edges 0 to 3");
    expect_one_problem(domain + "edges = []\n", "14:9: boundary \"boundary1\": edges = [] (", "names no edge");
    expect_one_problem(domain + "side = \"top\"\n", "14:8: boundary \"boundary1\": side (", "the domain is a polygon). Use edges");
    EXPECT_THAT(problems_of(domain + "edges = [0, 1, 2, 3]\n"), ElementsAre());
    expect_one_problem(test::two_blocks + "[[boundary]]\nside = \"top\"\nkind = \"roller\"\n",
                       "16:1: boundary \"boundary1\": boundary (", "there is no [domain]");
}

TEST(BoundaryErrors, ThatNeedTheBlocksToBeSeen)
{
    const std::string lid = rectangle + height + "[[boundary]]\nname = \"lid\"\nside = \"top\"\nkind = \"roller\"\n";
    const auto problem_of = [](const std::string& text)
    {
        try
        {
            build_model(test::read(text));
        }
        catch (const InputError& error)
        {
            EXPECT_EQ(error.problems().size(), 1U);
            return error.problems()[0].key + ": " + error.problems()[0].text;
        }
        return std::string("none");
    };
    EXPECT_EQ(problem_of(lid), "none");
    EXPECT_THAT(problem_of(lid + "[[block]]\npolygon = [[1, 4], [2, 4], [2, 5]]\n"),
                testing::AllOf(StartsWith("boundary[0]: "), HasSubstr("overlaps block \"block1\"")));
    EXPECT_THAT(problem_of(test::with(lid, "cycles = 10\n", "cycles = 10\nexcavate = [\"lid\"]\n")),
                testing::AllOf(StartsWith("stage[0].excavate: "), HasSubstr("it is the wall of a [[boundary]]")));
    EXPECT_THAT(problem_of(test::with(lid, "\"lid\"", "\"b1\"")),
                testing::AllOf(StartsWith("boundary[0].name: "), HasSubstr("a block is called \"b1\"")));
}

TEST(LoadErrors, OfPoints)
{
    const std::string load = test::two_blocks + "[[load]]\nblocks = [\"top\"]\n";
    expect_one_problem(load + "moment = 1\npoint = [0, 0]\n", "19:9: load \"load1\": point (", "belongs to force");
    expect_one_problem(test::two_blocks + "[[load]]\nblocks = [\"*\"]\nforce = [1, 0]\npoint = [0, 0]\n",
                       "19:9: load \"load1\": point (", "names several");
    try
    {
        build_model(test::read(load + "force = [1, 0]\npoint = [0.5, 1.1]\n"));
        FAIL() << "built";
    }
    catch (const InputError& error)
    {
        EXPECT_THAT(error.problems()[0].text, HasSubstr("it is not in the block as drawn"));
    }
}

TEST(Boundary, IsReadAsItIsWritten)
{
    const CaseDef def = test::read(rectangle + height + R"([insitu]
stress = [-1e6, -1e6, 0.0]
[[boundary]]
side = "left"
kind = "servo"
target = 2e6
max_velocity = 0.1
[[boundary]]
side = "top"
kind = "stress"
stress = [1e6, 2e5]
stages = ["load"]
[[boundary]]
side = "right"
kind = "stress"
stress = "insitu"
[[boundary]]
name = "ram"
side = "bottom"
kind = "velocity"
velocity = [0.1, 0.2]
)");
    ASSERT_EQ(def.boundaries.size(), 4U);
    EXPECT_EQ(def.boundaries[0].name, "boundary1");
    EXPECT_EQ(def.boundaries[0].kind, BoundaryKind::servo);
    EXPECT_EQ(def.boundaries[0].target, 2e6);
    EXPECT_EQ(def.boundaries[0].max_velocity, 0.1);
    EXPECT_EQ(def.boundaries[1].stress, Vec2(1e6, 2e5));
    EXPECT_EQ(def.boundaries[1].stages, std::vector<std::string>{"load"});
    EXPECT_TRUE(def.boundaries[2].is_insitu);
    EXPECT_FALSE(def.boundaries[2].stress);
    EXPECT_EQ(def.boundaries[3].name, "ram");
    EXPECT_EQ(def.boundaries[3].velocity, Vec2(0.1, 0.2));
}
}  // namespace
}  // namespace hdem
