#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace hdem
{
namespace
{
using test::problems_of;
using test::two_blocks;
using test::with;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// One mistake in a case that is legal otherwise, and how the only line about it begins and what it says.
struct Mistake
{
    const char* old;
    const char* wrong;
    const char* place_and_object;
    const char* says;
};

void expect_one_problem(const std::string& text, const Mistake& mistake)
{
    EXPECT_THAT(problems_of(text), ElementsAre(testing::AllOf(StartsWith(std::string("case.toml:") + mistake.place_and_object),
                                                              HasSubstr(mistake.says))))
        << mistake.wrong;
}

TEST(CaseErrors, WrongKeysTypesAndRanges)
{
    const Mistake mistakes[] = {
        {"density =", "densty =", "2:1: material \"rock\": densty = 2700 (", "unknown key; did you mean 'density'?"},
        {"friction_angle_deg = 30.0", "fricton_angle_dg = 30.0", "6:1: joint \"default\": fricton_angle_dg = 30 (",
         "did you mean 'friction_angle_deg'?"},
        {"cycles = 10", "cycles = 10\npersistance = 1", "16:1: stage \"stage1\": persistance = 1 (",
         "unknown key). [[stage]] has name, cycles,"},
        {"[material.rock]", "[materials.rock]", "1:2: case: [materials] (", "unknown section; did you mean 'material'?"},
        {"[material.rock]", "frobnicate = 1\n[material.rock]", "1:1: case: frobnicate = 1 (", "unknown key). io/case_format.md"},
        {"[material.rock]", "restitution = 1\n[material.rock]", "1:1: case: restitution = 1 (",
         "It belongs below [joint.NAME] or [contact]."},
        {"2700.0", "\"2700 kg\"", "2:11: material \"rock\": density = \"2700 kg\" (",
         "expected a number in kg/m3, got text). Values carry no unit"},
        {"2700.0", "true", "2:11: material \"rock\"", "expected a number in kg/m3, got true or false"},
        {"2700.0", "1979-05-27", "2:11: material \"rock\": density = a date (", "got a date"},
        {"2700.0", "-5", "2:11: material \"rock\": density = -5 kg/m3 (", "must be > 0"},
        {"2700.0", "0", "2:11: material", "must be > 0"},
        {"[material.rock]", "[contact]\nlength_floor = 0\n[material.rock]", "2:16: [contact]: length_floor = 0 (", "must be > 0"},
        {"[material.rock]", "blocks_file = \"\"\n[material.rock]", "1:15: case: blocks_file = \"\" (", "names no file"},
        {"2700.0", "nan", "2:11: material \"rock\": density = nan kg/m3 (", "must be finite). Give a number in kg/m3"},
        {"2700.0", "-inf", "2:11: material", "must be finite"},
        {"7e9", "0.0", "4:20: joint \"default\": normal_stiffness = 0 Pa/m (", "must be > 0"},
        {"5e8", "-5e8", "5:19: joint \"default\": shear_stiffness = -500000000 Pa/m (", "e.g. shear_stiffness = 5e8."},
        {"5e8", "1e300", "5:19: joint", "must be > 0 and <= 1e+18"},
        {"30.0", "90", "6:22: joint \"default\": friction_angle_deg = 90 deg (", "must be >= 0 and < 90"},
        {"friction_angle_deg = 30.0\n", "", "3:1: joint \"default\": friction_angle_deg (",
         "is missing). Add it: law \"coulomb\" needs it"},
        {"[0, 1]]", "[0, 1, 2]]", "13:36: block \"top\": polygon[3] = [0, 1, 2] (", "has 3 numbers"},
        {"[0, 1]]", "[0, \"1\"]]", "13:40: block \"top\": polygon[3][1] = \"1\" (", "expected a number in m, got text"},
        {"[[0, 0], [1, 0], [1, 1], [0, 1]]", "[[0, 0], [1, 0]]", "13:11: block \"top\": polygon = [[...], [...]] (",
         "has 2 vertices"},
        {"[[0, 0], [1, 0], [1, 1], [0, 1]]", "3", "13:11: block \"top\": polygon = 3 m (", "expected a list of points"},
        {"fixed = true", "fixed = [\"x\", \"rotaton\"]", "10:15: block \"ground\": fixed[1] = \"rotaton\" (",
         "did you mean 'rotation'?"},
        {"fixed = true", "fixed = 1", "10:9: block \"ground\": fixed = 1 (", "expected true, false or a list from"},
        {"cycles = 10", "cycles = 10.5", "15:10: stage \"stage1\": cycles = 10.5 (", "must be a whole number"},
        {"cycles = 10", "cycles = 0", "15:10: stage \"stage1\": cycles = 0 (", "must be 1 to 1000000000000000"},
        {"cycles = 10", "until = \"convergd\"", "15:9: stage \"stage1\": until = \"convergd\" (", "did you mean 'converged'?"},
        {"cycles = 10", "cycles = 10\nmethod = \"magic\"", "16:10: stage \"stage1\": method = \"magic\" (",
         "Choose from \"force\", \"impulse\", \"hybrid\""},
        {"[[stage]]", "[stage]", "14:1: stage: stage = {...} (", "can occur several times). Write [[stage]]"},
        {"[material.rock]\ndensity = 2700.0", "schema = 2\n[material.rock]\ndensity = 2700.0", "1:10: case: schema = 2 (",
         "must be 1"},
        {"[joint.default]", "[joint]", "4:20: joint: normal_stiffness = 7000000000 (",
         "a joint has a name). Write [joint.default]"},
    };
    for (const Mistake& mistake : mistakes)
    {
        const std::string text = with(two_blocks, mistake.old, mistake.wrong);
        if (std::string(mistake.wrong) == "[joint]")
            EXPECT_THAT(problems_of(text).front(),
                        testing::AllOf(StartsWith(std::string("case.toml:") + mistake.place_and_object), HasSubstr(mistake.says)));
        else
            expect_one_problem(text, mistake);
    }
}

TEST(CaseErrors, ContradictionsAndUnknownNames)
{
    const Mistake mistakes[] = {
        {"", "[domain]\nwidth = 1\npolygon = [[0, 0], [1, 0], [1, 1]]\n", "17:9: [domain]: width (", "contradicts polygon"},
        {"", "[domain]\nwidth = 1\n", "16:1: [domain]: height (", "is missing"},
        {"", "[domain]\nwidth = 1\nheight = 1\nmaterial = \"rok\"\n", "19:12: [domain]: material = \"rok\" (",
         "did you mean 'rock'?"},
        {"", "[domain]\npolygon = [[0, 0], [1, 0], [1, 1]]\nfixed = [\"left\"]\n", "18:9: [domain]: fixed (", "Use fixed_edges"},
        {"", "[domain]\nwidth = 1\nheight = 1\nfixed_edges = [0]\n", "19:15: [domain]: fixed_edges", "the domain is a rectangle"},
        {"", "[[joint_set]]\ndip_deg = 0\nspacing = 2\n", "16:1: case: [[joint_set]] (", "there is no [domain]"},
        {"", "[domain]\nwidth = 9\nheight = 9\n[[joint_set]]\ndip_deg = 0\nspacing = 2\njoint = \"defalt\"\n",
         "22:9: joint set \"set1\": joint = \"defalt\" (", "did you mean 'default'?"},
        {"", "[[block]]\nname = \"top\"\npolygon = [[0, 0], [1, 0], [1, 1]]\n", "17:8: block 3: name = \"top\" (",
         "block 2 has this name already"},
        {"", "[[block]]\nname = \"a;b\"\npolygon = [[0, 0], [1, 0], [1, 1]]\n", "17:8: block 3: name = \"a;b\" (",
         "cannot be a name"},
        {"", "[[block]]\nmaterial = \"ice\"\npolygon = [[0, 0], [1, 0], [1, 1]]\n", "17:12: block \"block3\": material = \"ice\" (",
         "no material has this name). There is \"rock\"."},
        {"", "[[block]]\nname = \"b\"\n", "16:1: block \"b\": polygon (", "is missing"},
        {"", "[joint.default.x]\n", "16:16: joint \"default\": x = {...} (", "unknown key"},
        {"", "[joint.default]\nmaterials = [\"rock\", \"rock\"]\n", "16:", "not valid TOML"},
        {"", "[joint.\"a b\"]\nnormal_stiffness = 1\n", "16:1: joint: name = \"a b\" (", "letters, digits"},
        {"", "[joint.j]\nnormal_stiffness = 1\nshear_stiffness = 1\nfriction_angle_deg = 30\ntension = 1\n",
         "20:11: joint \"j\": tension (", "is greater than cohesion / tan(friction)"},
        {"", "[joint.j]\nnormal_stiffness = 1\nshear_stiffness = 1\nfriction_angle_deg = 30\njrc = 1\n", "20:7: joint \"j\": jrc (",
         "does not belong to law \"coulomb\""},
        {"", "[joint.j]\nnormal_stiffness = 1\nshear_stiffness = 1\nfriction_angle_deg = 30\ndilation_angle_deg = 31\n",
         "20:22: joint \"j\": dilation_angle_deg (", "slip would make energy"},
        {"", "[joint.j]\nnormal_stiffness = 1\nshear_stiffness = 1\nfriction_angle_deg = 1\nmaterials = [\"rock\"]\n",
         "20:13: joint \"j\": materials (", "names 1 materials"},
        {"", "[joint.j]\nnormal_stiffness = 1\nshear_stiffness = 1\nfriction_angle_deg = 1\nmaterials = [\"rock\", \"sand\"]\n",
         "20:13: joint \"j\": materials = \"sand\" (", "no material has this name"},
        {"", "[[load]]\nblocks = [\"top\"]\n", "16:1: load \"load1\": load (", "does nothing"},
        {"", "[[load]]\nblocks = [\"tpo\"]\nmoment = 1\n", "17:10: load \"load1\": blocks = \"tpo\" (", "did you mean 'top'?"},
        {"", "[[load]]\nblocks = []\nmoment = 1\n", "17:10: load \"load1\": blocks = [] (", "names no block"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\nfrom_cycle = 5\nuntil_cycle = 5\n",
         "20:15: load \"load1\": until_cycle = 5 (", "ends before it begins"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\nfrom_cycle = 5\nfrom_time = 1\n", "20:13: load \"load1\": from_time (",
         "contradicts from_cycle"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\nramp_cycles = [5, 5]\n", "19:15: load \"load1\": ramp_cycles = [5, 5] (",
         "ends before it begins"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\nramp_cycles = [0, 5]\ntable = [[0, 1], [1, 2]]\n",
         "20:9: load \"load1\": table (", "contradicts ramp_cycles"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\ntable = [[0, 1], [5, 2], [5, 3]]\n",
         "19:9: load \"load1\": table[2] = [5, 3] (", "comes after 5). Sort the rows"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\ntable = [[0, 1]]\n", "19:9: load \"load1\": table = [[...]] (", "at least 2"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\ntable_by = \"time\"\n", "19:12: load \"load1\": table_by (",
         "belongs to table"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\nsince = \"stage2\"\n", "19:9: load \"load1\": since = \"stage2\" (",
         "no stage has this name"},
        {"", "[[load]]\nblocks = [\"*\"]\nmoment = 1\ntable_file = \"absent.csv\"\n",
         "19:14: load \"load1\": table_file = \"absent.csv\" (", "absent.csv does not exist"},
        {"", "[joint.j]\nnormal_stiffness = 1\nshear_stiffness = 1\nfriction_angle_deg = 1\ndilation_limit = 0.01\n",
         "20:18: joint \"j\": dilation_limit = 0.01 (",
         "belongs to dilation_angle_deg, which is not given). Give dilation_angle_deg, or"},
        {"", "[[stage]]\ncycles = 5\nset_cycles = 3\n", "18:14: stage \"stage2\": set_cycles = 3 (", "belongs to set"},
        {"", "[[stage]]\ncycles = 5\nset = [\"joint.default.cohesion = 5\"]\nset_cycles = 6\n",
         "19:14: stage \"stage2\": set_cycles = 6 (", "more than the stage's cycles = 5"},
        {"", "[[stage]]\ncycles = 5\nset = [\"joint.default.cohesion = 5\"]\nset_table = [[0, 0], [5, 0.9]]\n",
         "19:13: stage \"stage2\": set_table[1] = [5, 0.9] (", "not whole at the end"},
        {"", "[[stage]]\ncycles = 5\nset = [\"joint.default.cohesion = 5\"]\nset_table = [[3, 0], [2, 1]]\n",
         "19:13: stage \"stage2\": set_table[1] = [2, 1] (", "comes after 3"},
        {"", "[[stage]]\ncycles = 5\nset = [\"joint.default.cohesion = 5\"]\nset_table = [[0, 2], [5, 1]]\n",
         "19:13: stage \"stage2\": set_table[0] = [0, 2] (", "shares are from 0 to 1"},
        {"", "[[stage]]\ncycles = 5\nset = [\"joint.default.cohesion = 5\"]\nset_table = [[0, 0], [6, 1]]\n",
         "19:13: stage \"stage2\": set_table[1] = [6, 1] (", "more than the stage's cycles = 5"},
        {"", "[[stage]]\ncycles = 5\nset_table = [[0, 0], [5, 1]]\n", "18:13: stage \"stage2\": set_table (", "belongs to set"},
        {"", "[[stage]]\ncycles = 5\nset = [\"joint.default.cohesion = 5\"]\nset_table_by = \"time\"\n",
         "19:16: stage \"stage2\": set_table_by (", "belongs to set_table"},
        {"", "[[stage]]\ncycles = 5\nset = [\"joint.default.shear_stiffness = 5\"]\nset_cycles = 4\n",
         "18:7: stage \"stage2\": set = \"joint.default: shear_stiffness\" (", "only strengths change over set_cycles"},
        {"", "[[stage]]\ncycles = 5\nset = [\"material.rock.density = 5\"]\nset_cycles = 4\n", "18:7: stage \"stage2\": set",
         "only strengths of joints change over set_cycles"},
        {"", "[[stage]]\ncycles = 5\nrelax_to = 0.5\n", "18:12: stage \"stage2\": relax_to = 0.5 (", "belongs to relax_cycles"},
        {"", "[[load]]\nblocks = [\"top\"]\nvelocity_x = 1\n", "18:14: load \"load1\": velocity_x (",
         "component of block \"top\" is free"},
        {"", "[contact]\nthreshold_scale = 2\nthreshold_velocity = 1\n", "18:22: [contact]: threshold_velocity (",
         "contradicts threshold_scale"},
        {"", "[contact]\nthreshold_scale = \"modle\"\n", "17:19: [contact]: threshold_scale = \"modle\" (",
         "did you mean 'model'?"},
        {"", "[damping]\nglobal_damping_ratio = 0.1\n", "17:24: [damping]: global_damping_ratio (",
         "Give average_frequency as well"},
        {"", "[convergence]\ncriteria = []\n", "17:12: [convergence]: criteria = [] (", "nothing would ever converge"},
        {"", "[[stage]]\ncycles = 5\nuntil = \"converged\"\n", "18:9: stage \"stage2\": until (", "contradicts cycles"},
        {"", "[[stage]]\nuntil = [\"converged\", \"displacement:botom > 0.1\"]\n", "17:9: stage \"stage2\": until = \"botom\" (",
         "no block has this name"},
        {"", "[[stage]]\nuntil = [\"displacment:top > 0.1\"]\n", "17:9: stage \"stage2\": until = \"displacment:top > 0.1\" (",
         "did you mean 'displacement'?"},
        {"", "[[stage]]\nuntil = []\n", "17:9: stage \"stage2\": until = [] (", "names no end"},
        {"", "[[stage]]\nuntil = \"history:h.speed > 1\"\n", "17:9: stage \"stage2\": until = \"h\" (", "no history has this name"},
        {"",
         "[[history]]\nname = \"h\"\nblock = \"top\"\nquantities = [\"speed\"]\n[[stage]]\nuntil = \"history:h.velocity > 1\"\n",
         "21:9: stage \"stage2\": until = \"history:h.velocity > 1\" (", "Write velocity_x or velocity_y."},
        {"", "[[history]]\nname = \"h\"\nblock = \"top\"\nquantities = [\"speed\"]\n[[stage]]\nuntil = \"history:h.overlap > 1\"\n",
         "21:9: stage \"stage2\": until = \"history:h.overlap > 1\" (", "no such column"},
        {"", "[[history]]\npoint = [1, 1]\nquantities = [\"speed\"]\n", "18:14: history \"history1\": quantities = \"speed\" (",
         "belongs to block"},
        {"", "[[history]]\npoint = [1, 1]\nblock = \"top\"\nquantities = [\"speed\"]\n", "17:9: history \"history1\": point (",
         "contradicts block"},
        {"", "[[stage]]\nname = \"end\"\n", "16:1: stage \"end\": cycles, duration, until (", "has no end"},
        {"", "[[stage]]\ncycles = 5\nmax_cycles = 5\n", "18:14: stage \"stage2\": max_cycles (", "limits a stage with until"},
        {"", "[[stage]]\ncycles = 5\nrelax_cycles = 5\n", "18:16: stage \"stage2\": relax_cycles = 5 (", "nothing is excavated"},
        {"", "[[stage]]\ncycles = 5\nrelax_cycles = 6\nexcavate = [\"top\"]\n", "18:16: stage \"stage2\": relax_cycles = 6 (",
         "is more than the stage's cycles = 5"},
        {"", "[[stage]]\ncycles = 5\nexcavate = [\"tunnel\"]\n", "18:12: stage \"stage2\": excavate = \"tunnel\" (",
         "no excavation or block has this name"},
        {"", "[[stage]]\ncycles = 5\nexcavate = [\"top\", \"top\"]\n", "18:12: stage \"stage2\": excavate = \"top\" (",
         "removed already"},
        {"", "[[stage]]\ncycles = 5\nfix = [\"top\"]\nfree = [\"top\"]\n", "19:8: stage \"stage2\": free = \"top\" (",
         "the same stage fixes it"},
        {"", "[[history]]\nquantities = [\"velocity\"]\n", "16:1: history \"history1\": block, between, point (", "none is given"},
        {"", "[[history]]\nblock = \"top\"\nquantities = [\"overlap\"]\n",
         "18:14: history \"history1\": quantities = \"overlap\" (", "belongs to between"},
        {"", "[[history]]\nblock = \"top\"\nquantities = [\"velocty\"]\n",
         "18:15: history \"history1\": quantities[0] = \"velocty\" (", "did you mean 'velocity'?"},
        {"", "[[history]]\nbetween = [\"top\"]\nquantities = [\"overlap\"]\n", "17:11: history \"history1\": between (",
         "two different blocks"},
        {"", "[[history]]\nblock = \"botom\"\nquantities = [\"velocity\"]\n", "17:9: history \"history1\": block = \"botom\" (",
         "no block has this name"},
        {"", "[[history]]\nblock = \"top\"\nquantities = []\n", "18:14: history \"history1\": quantities = [] (",
         "names nothing to sample"},
        {"", "[domain]\nwidth = 9\nheight = 9\n[[excavation]]\nname = \"t\"\nshape = \"circle\"\nposition = [1, 1]\n",
         "19:1: excavation \"t\": diameter (", "a circle needs it"},
        {"",
         "[domain]\nwidth = 9\nheight = 9\n[[excavation]]\nname = \"t\"\nshape = \"circle\"\nposition = [1, 1]\ndiameter = "
         "1\nwidth = 2\n",
         "24:9: excavation \"t\": width (", "a circle has none"},
        {"", "blocks_file = \"absent.wkt\"\n", "16:1: stage \"stage1\": blocks_file = \"absent.wkt\" (", "unknown key"},
    };
    for (const Mistake& mistake : mistakes)
        expect_one_problem(two_blocks + mistake.wrong, mistake);
}

TEST(CaseErrors, DefaultJointIsNotForOnePairOnly)
{
    expect_one_problem(
        with(two_blocks, "[[block]]\nname = \"ground\"", "materials = [\"rock\", \"rock\"]\n[[block]]\nname = \"ground\""),
        {"", "materials", "7:13: joint \"default\": materials (", "the default is for all that remains"});
}

TEST(CaseErrors, WhatIsMissingFromTheWholeCase)
{
    const std::string no_rock = two_blocks.substr(0, two_blocks.find("[[block]]")) + "[[stage]]\ncycles = 1\n";
    EXPECT_THAT(problems_of(no_rock), ElementsAre(HasSubstr("there is no rock")));
    const std::string no_stage = two_blocks.substr(0, two_blocks.find("[[stage]]"));
    EXPECT_THAT(problems_of(no_stage), ElementsAre(HasSubstr("nothing would be run")));
    EXPECT_THAT(problems_of("stage = []\n" + no_stage), ElementsAre(StartsWith("case.toml:1:9: case: [[stage]]")));
    EXPECT_THAT(problems_of(with(two_blocks, "[joint.default]", "[joint.other]")),
                ElementsAre(HasSubstr("[joint.default] (is missing")));
    EXPECT_EQ(problems_of("").size(), 3U) << "no rock, no joint, no stage";
    EXPECT_THAT(problems_of("blocks_file = \"absent.wkt\"\n" + two_blocks),
                ElementsAre(StartsWith("case.toml:1:15: case: blocks_file = \"absent.wkt\" (absent.wkt does not exist")));
}

TEST(CaseErrors, AllAreReportedAtOnceInTheOrderOfTheFile)
{
    std::string text = with(two_blocks, "2700.0", "-1");
    text = with(text, "shear_stiffness", "shear_stifness");
    text = with(text, "fixed = true", "fixed = \"yes\"");
    text = with(text, "cycles = 10", "cycles = -1");
    EXPECT_THAT(problems_of(text), ElementsAre(StartsWith("case.toml:2:11:"), StartsWith("case.toml:5:1:"),
                                               StartsWith("case.toml:10:9:"), StartsWith("case.toml:15:10:")));
}

TEST(CaseErrors, WholeLineFollowsTheGrammar)
{
    EXPECT_THAT(problems_of(with(two_blocks, "30.0", "-1")),
                ElementsAre("case.toml:6:22: joint \"default\": friction_angle_deg = -1 deg (must be >= 0 and < 90). Give a number "
                            "in deg, >= 0 and < 90, e.g. friction_angle_deg = 30.0."));
}

TEST(CaseErrors, TextThatIsNotToml)
{
    const Mistake texts[] = {
        {"", "title = \"a\"\ntitle = \"b\"\n", "2:9: case: (not valid TOML: ", "cannot redefine existing string 'title'"},
        {"", "[domain]\n[domain]\n", "2:", "not valid TOML"},
        {"", "title = ", "1:", "not valid TOML"},
        {"", "a = 1e999\n", "1:", "not valid TOML"},
        {"", "a = 99999999999999999999\n", "1:", "not valid TOML"},
        {"", "a = \"\xff\"\n", "1:", "utf-8"},
        {"", "\x7f\x45\x4c\x46\x02\x01", "1:", "not valid TOML"},
    };
    for (const Mistake& text : texts)
        expect_one_problem(text.wrong, text);
    expect_one_problem(std::string(3, '\0'), {"", "NUL", "1:", "not valid TOML"});
    expect_one_problem("a = " + std::string(100'000, '['), {"", "nested", "1:", "maximum nested value depth"});
}

/// Two million dots once made two million nested tables, whose destruction exhausted the stack.
TEST(CaseErrors, DeepDottedKeysAreRefusedBeforeTheyAreParsed)
{
    std::string dots;
    for (int i = 0; i < 2'000'000; ++i)
        dots += "a.";
    EXPECT_THAT(problems_of("# a.b.c.d.e.f.g.h.i.j.k\n" + dots + "b = 1\n"),
                ElementsAre(HasSubstr("case.toml:2:18: case: (a key has more than 8 dots)")));
    EXPECT_THAT(problems_of("[" + dots + "b]\n"), ElementsAre(HasSubstr("more than 8 dots")));
    EXPECT_THAT(problems_of("x = '''it's''' # \"\n[" + dots + "b]\n"), ElementsAre(HasSubstr("case.toml:2:19:")));
    EXPECT_THAT(problems_of("x = \"\"\"\n\\\"\"\" \"\"\"\n[" + dots + "b]\n"), ElementsAre(HasSubstr("more than 8 dots")));
    std::string nested = "x = 1";
    for (int i = 0; i < 300; ++i)
        nested = "x.x.x.x.x.x.x.x = {" + nested + "}";
    EXPECT_EQ(problems_of(nested).size(), 1U);
    EXPECT_TRUE(problems_of("title = \"a.b.c.d.e.f.g.h.i.j.k.l\" # ...........\n" + two_blocks).empty());
}

TEST(CaseErrors, FilesThatCannotBeRead)
{
    const auto folder = std::filesystem::path(testing::TempDir());
    const auto problem_of = [](const std::filesystem::path& file)
    {
        try
        {
            read_case_file(file);
        }
        catch (const InputError& error)
        {
            return error.problems().front().text;
        }
        return std::string();
    };
    EXPECT_THAT(problem_of(folder), HasSubstr("is a folder"));
    EXPECT_THAT(problem_of(folder / "absent.toml"), HasSubstr("does not exist"));
    EXPECT_THAT(problem_of("/dev/zero"),
                HasSubstr("/dev/zero: case: (is a pipe, a socket or a device). Write the text to a file first"));
    std::ofstream(folder / "big.toml") << std::string(largest_case_file + 1, ' ');
    EXPECT_THAT(problem_of(folder / "big.toml"), HasSubstr("larger than 16000000 bytes"));
    std::ofstream(folder / "empty.toml").flush();
    EXPECT_THAT(problem_of(folder / "empty.toml"), HasSubstr("there is no rock"));
}

TEST(CaseErrors, MoreMaterialsThanTheTableOfTheirPairsHolds)
{
    std::string text = two_blocks;
    for (int i = 0; i < 4096; ++i)
        text += "\n[material.m" + std::to_string(i) + "]\ndensity = 1.0\n";
    EXPECT_THAT(problems_of(text), ElementsAre(HasSubstr("4097 materials (at most 4096")));
}

TEST(CaseErrors, ThousandsAreCutShort)
{
    std::string text;
    for (int i = 0; i < 5000; ++i)
        text += "key" + std::to_string(i) + " = 1\n";
    const auto lines = problems_of(text);
    EXPECT_EQ(lines.size(), 201U);
    EXPECT_THAT(lines.front(), HasSubstr("more errors"));
}
}  // namespace
}  // namespace hdem
