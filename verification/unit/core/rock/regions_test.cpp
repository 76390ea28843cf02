#include "core/geometry/unit_direction.h"
#include "core/rock/fault_lines.h"
#include "io/load_case.h"
#include "io/traces.h"
#include "verification/unit/case_run.h"
#include "verification/unit/core/rock/rock_invariants.h"
#include "verification/unit/io/case_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <random>

namespace hdem
{
namespace
{
using test::CaseRun;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string laws = R"([material.rock]
density = 2700.0
[material.shale]
density = 2400.0
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 30.0
[joint.fault]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 10.0
[joint.bedding]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 20.0
[joint.in_shale]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 15.0
materials = ["shale", "shale"]
[[stage]]
cycles = 1
)";

const std::string square = "[domain]\npolygon = [[0, 0], [4, 0], [4, 4], [0, 4]]\n";

/// A fault half way up; joints a metre apart above it, which stand upright.
const std::string two_halves = square + R"([[fault]]
name = "main"
points = [[-1, 2], [5, 2]]
joint = "fault"
[[region]]
name = "upper"
above = "main"
[[joint_set]]
name = "columns"
dip_deg = 90.0
spacing = 1.0
origin = [0, 0]
joint = "bedding"
region = "upper"
)" + laws;

/// Shale of 2 m in the middle, in two beds; the rock around it is parted by one upright joint.
const std::string lens = square + R"([[region]]
name = "lens"
polygon = [[1, 1], [3, 1], [3, 3], [1, 3]]
material = "shale"
joint = "bedding"
[[joint_set]]
name = "beds"
dip_deg = 0.0
spacing = 1.0
origin = [0, 0]
region = "lens"
[[joint_set]]
name = "upright"
dip_deg = 90.0
spacing = 2.0
origin = [0, 0]
outside = "lens"
)" + laws;

Vec2 turned(const Vec2& p, const Vec2& by)
{
    return {by.x() * p.x() - by.y() * p.y(), by.y() * p.x() + by.x() * p.y()};
}

void turn_all(Polygon& points, const Vec2& by)
{
    for (Vec2& p : points)
        p = turned(p, by);
}

/// The case with all of its geometry turned about the origin.
CaseDef case_of(const std::string& text, double turn_deg = 0.0)
{
    CaseDef def = test::read(text);
    if (turn_deg == 0.0)
        return def;
    const Vec2 by = unit_direction(turn_deg);
    turn_all(def.domain.polygon, by);
    for (FaultDef& fault : def.faults)
        turn_all(fault.points, by);
    for (RegionDef& region : def.regions)
        turn_all(region.polygon, by);
    for (ExcavationDef& excavation : def.excavations)
        excavation.position = turned(excavation.position, by);
    for (JointSetDef& set : def.joint_sets)
    {
        set.dip_deg += turn_deg;
        if (set.origin)
            set.origin = turned(*set.origin, by);
    }
    def.trace_cells = cut_into_cells(def.domain.polygon, {}, 0.0, source_lines(def));
    return def;
}

std::vector<double> areas(const RockMass& rock, const std::string& material)
{
    std::vector<double> found;
    for (const RockBlock& block : rock.blocks)
        if (block.material == material)
            found.push_back(std::round(area(block) * 1e6) * 1e-6);
    std::sort(found.begin(), found.end());
    return found;
}

/// Names of the joints between blocks that lie on each other, and the total length of each [m].
std::map<std::string, double> joint_lengths(const CaseDef& def)
{
    const CaseRun run(def);
    const Contacts& contacts = run.state().contacts;
    std::map<std::string, double> lengths;
    for (Index i = 0; i < contacts.size(); ++i)
        if (const double length = report_contact(run.state(), i).length; length > 0.01)
            lengths[run.model().joints.names[contacts.law[i]]] += length;
    return lengths;
}

std::vector<std::string> all_warnings(const std::string& text)
{
    std::vector<std::string> texts;
    for (const Problem& problem : load_case(text, NamedFiles{}, "case.toml", {}).warnings)
        texts.push_back(problem.text);
    return texts;
}

/// What is wrong with a legal file's geometry.
std::string problem_of(const std::string& text)
{
    try
    {
        (void)load_case(text, NamedFiles{}, "case.toml", {});
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return {};
}

class Turned : public testing::TestWithParam<double>
{
};
INSTANTIATE_TEST_SUITE_P(Regions, Turned, testing::Values(0.0, 23.0));

TEST_P(Turned, ASetCutsOneSideOfAFault)
{
    const CaseDef def = case_of(two_halves, GetParam());
    const RockMass rock = generate_rock_mass(def);
    expect_sound(rock);
    EXPECT_THAT(areas(rock, "rock"), ElementsAre(2.0, 2.0, 2.0, 2.0, 8.0));
    EXPECT_TRUE(rock.warnings.empty());
    const auto lengths = joint_lengths(def);
    ASSERT_EQ(lengths.size(), 2u);
    EXPECT_NEAR(lengths.at("fault"), 4.0, 1e-6);
    EXPECT_NEAR(lengths.at("bedding"), 3.0 * 2.0, 1e-6);
}

TEST_P(Turned, AZoneHasItsMaterialItsSetsAndItsOutline)
{
    const CaseDef def = case_of(lens, GetParam());
    const RockMass rock = generate_rock_mass(def);
    expect_sound(rock);
    EXPECT_THAT(areas(rock, "shale"), ElementsAre(2.0, 2.0));
    EXPECT_THAT(areas(rock, "rock"), ElementsAre(6.0, 6.0));
    const auto lengths = joint_lengths(def);
    ASSERT_EQ(lengths.size(), 3u);
    EXPECT_NEAR(lengths.at("in_shale"), 2.0, 1e-6) << "between the beds";
    EXPECT_NEAR(lengths.at("bedding"), 8.0, 1e-6) << "along the outline";
    EXPECT_NEAR(lengths.at("default"), 2.0, 1e-6) << "above and below the lens";
}

/// An outline along the domain's boundary and a fault adds no joint there, and no sliver.
TEST_P(Turned, AnOutlineAlongWhatIsThereIsNotCutAgain)
{
    const CaseDef def = case_of(test::with(two_halves, "above = \"main\"", "polygon = [[0, 2], [3, 2], [3, 4], [0, 4]]"),
                                GetParam());
    ASSERT_EQ(source_lines(def).size(), 2u) << "the fault, and one of four edges";
    EXPECT_EQ(source_lines(def)[1].points.size(), 2u);
    const RockMass rock = generate_rock_mass(def);
    expect_sound(rock);
    EXPECT_THAT(areas(rock, "rock"), ElementsAre(2.0, 2.0, 2.0, 2.0, 8.0)) << "cut at 1 and 2 by the set, at 3 by the outline";
}

TEST_P(Turned, ABentFaultPartsWhatIsAboveFromWhatIsBelow)
{
    const std::string bent = test::with(two_halves, "[[-1, 2], [5, 2]]", "[[5, 1], [2, 3], [-1, 1]]");
    const CaseDef above = case_of(bent, GetParam());
    const CaseDef below = case_of(test::with(bent, "above =", "below ="), GetParam());
    expect_sound(generate_rock_mass(above));
    // The fault rises by 2/3 from 5/3 at the side, so it is at 7/3 a metre from the sides and at 3 in the middle.
    EXPECT_THAT(areas(generate_rock_mass(above), "rock"),
                ElementsAre(testing::DoubleNear(4.0 / 3.0, 1e-5), testing::DoubleNear(4.0 / 3.0, 1e-5), 2.0, 2.0, testing::_));
    EXPECT_THAT(areas(generate_rock_mass(below), "rock").size(), 5u);
    EXPECT_NEAR(summed_area(generate_rock_mass(below)), 16.0, 1e-9);
}

/// Where two faults meet, the wedge between them has a set of its own; an excavation takes parts of all.
TEST(Regions, LieBetweenFaultsAndAreExcavated)
{
    const std::string text = test::with(two_halves, "[[region]]\nname = \"upper\"\nabove = \"main\"\n",
                                        "[[fault]]\nname = \"steep\"\npoints = [[1, 1.5], [3, 5]]\n"
                                        "[[region]]\nname = \"upper\"\nabove = \"main\"\nbelow = \"steep\"\n"
                                        "[[excavation]]\nname = \"hole\"\nshape = \"circle\"\nposition = [2, 2]\ndiameter = 2.0\n");
    const CaseDef def = case_of(text);
    const RockMass rock = generate_rock_mass(def);
    expect_sound(rock);
    std::size_t inside = 0;
    for (const RockBlock& block : rock.blocks)
        inside += block.excavation == 0 ? 1 : 0;
    EXPECT_EQ(inside, 4u) << "below the fault, the wedge left and right of the joint at 2, and the rest above";
    ASSERT_EQ(rock.warnings.size(), 1u);
    EXPECT_THAT(rock.warnings[0].text, HasSubstr("fault \"steep\": points (0.575"));
}

/// Faults and regions come before the sets, and take no numbers from them.
TEST(Regions, LeaveTheJointsOfSetsAsTheyAre)
{
    const std::string plain = square + R"([[joint_set]]
dip_deg = 80.0
spacing = 0.7
deviation_deg = 6.0
)" + laws;
    const std::string cut = test::with(plain, "[[joint_set]]",
                                       "[[region]]\nname = \"lens\"\npolygon = [[1, 1], [3, 1], [3, 2], [1, 2]]\n"
                                       "[[fault]]\nname = \"main\"\npoints = [[-1, 3], [5, 2.5]]\n[[joint_set]]");
    std::string split = test::with(cut, "spacing = 0.7",
                                   "spacing = 0.7\nregion = \"lens\"\nseed = 5\n[[joint_set]]\ndip_deg = 80.0\n"
                                   "spacing = 0.7\nseed = 5\noutside = \"lens\"");
    split.replace(split.find("[[joint_set]]"), 13, "[[joint_set]]\ndeviation_deg = 6.0");
    const auto at_the_bottom = [](const CaseDef& def)
    {
        std::set<double> found;
        for (const RockBlock& block : generate_rock_mass(def).blocks)
            for (const ConvexPart& part : block.parts)
                for (const Vec2& p : part.vertices)
                    if (std::abs(p.y()) < 1e-12)
                        found.insert(std::round(p.x() * 1e9));
        return found;
    };
    const std::set<double> joints = at_the_bottom(case_of(plain));
    EXPECT_GT(joints.size(), 5u);
    EXPECT_EQ(at_the_bottom(case_of(cut)), joints);
    const std::string seeded = test::with(plain, "spacing = 0.7", "spacing = 0.7\nseed = 5");
    EXPECT_EQ(at_the_bottom(case_of(split)), at_the_bottom(case_of(seeded)));
    EXPECT_NE(at_the_bottom(case_of(seeded)), joints);
    expect_sound(generate_rock_mass(case_of(split)));
}

/// Which blocks a set of short joints cuts is drawn from the same numbers.
TEST(Regions, AFaultThatPartsNothingChangesNoBlock)
{
    const std::string plain = square +
                              "[[joint_set]]\ndip_deg = 70\nspacing = 0.6\n[[joint_set]]\ndip_deg = -10\nspacing = 0.5\n"
                              "persistence = 0.5\n" +
                              laws;
    const std::string cut = plain + "[[fault]]\nname = \"inner\"\npoints = [[1, 1], [3, 2]]\n";
    const RockMass rock = generate_rock_mass(case_of(cut));
    EXPECT_EQ(areas(rock, "rock"), areas(generate_rock_mass(case_of(plain)), "rock"));
    EXPECT_GT(rock.skipped_cuts, 10);
}

/// Whatever is drawn: nothing is lost, neighbours meet end to end, and each zone has its area.
TEST(Regions, FillTheDomainAtRandom)
{
    int made = 0;
    for (unsigned seed = 0; seed < 40; ++seed)
    {
        std::mt19937 random(seed);
        const auto place = [&](double low, double high)
        { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; };
        const auto point = [&](double low, double high) { return fmt::format("[{}, {}]", place(low, high), place(low, high)); };
        const double x = place(0.5, 2.0), y = place(0.5, 2.0), width = place(0.3, 2.5), height = place(0.3, 2.5);
        const std::string
            text = square +
                   fmt::format("[[fault]]\nname = \"a\"\npoints = [[-1, {}], {}, [5, {}]]\n", place(1, 3), point(1, 3),
                               place(1, 3)) +
                   fmt::format("[[fault]]\nname = \"b\"\npoints = [{}, {}]\n", point(-1, 3), point(1, 5)) +
                   "[[region]]\nname = \"upper\"\nabove = \"a\"\n" +
                   fmt::format("[[region]]\nname = \"zone\"\npolygon = [[{0}, {1}], [{2}, {1}], [{2}, {3}], [{0}, {3}]]\n", x, y,
                               std::min(x + width, 4.0), std::min(y + height, 4.0)) +
                   fmt::format(
                       "material = \"shale\"\n[[joint_set]]\ndip_deg = {}\nspacing = 0.6\ndeviation_deg = 3\nregion = \"upper\"\n",
                       place(-90, 90)) +
                   fmt::format("[[joint_set]]\ndip_deg = {}\nspacing = 0.5\noutside = \"zone\"\n", place(-90, 90)) +
                   "[[excavation]]\nname = \"hole\"\nshape = \"circle\"\nposition = [2, 2]\ndiameter = 1.5\n" + laws;
        SCOPED_TRACE(text);
        const RockMass rock = generate_rock_mass(case_of(text, seed % 2 == 0 ? 0.0 : 23.0));
        expect_sound(rock);
        double shale = 0.0;
        for (const RockBlock& block : rock.blocks)
            shale += block.material == "shale" ? area(block) : 0.0;
        EXPECT_NEAR(shale, (std::min(x + width, 4.0) - x) * (std::min(y + height, 4.0) - y), 1e-4);
        made += static_cast<int>(rock.blocks.size());
    }
    EXPECT_GT(made, 2000);
}

TEST(Regions, AFaultGoesBeforeASetAndTraces)
{
    const Model model = build_model(case_of(two_halves)).model;
    const Index set = 2;  // after the fault and the outline
    EXPECT_EQ(model.joints.names[model.joints.find(0, set, 0, 0)], "fault");
    EXPECT_EQ(model.joints.names[model.joints.find(set, 0, 0, 0)], "fault");
    EXPECT_EQ(model.joints.names[model.joints.find(set, edge_plain, 0, 0)], "bedding");
    EXPECT_THAT(model.joint_set_names, ElementsAre("fault main", "outline of upper", "columns"));
}

TEST(Regions, DeadEndsAreDroppedWithAWarning)
{
    const std::string alone = test::with(test::with(two_halves, "[5, 2]]", "[2.5, 2]]"), "region = \"upper\"\n", "");
    const std::string without_region = test::with(alone, "[[region]]\nname = \"upper\"\nabove = \"main\"\n", "");
    EXPECT_THAT(all_warnings(without_region),
                ElementsAre(HasSubstr("fault \"main\": points (2.5 m end inside a block and part nothing: they are dropped)")));
    EXPECT_EQ(generate_rock_mass(case_of(without_region)).blocks.size(), 4u);
    EXPECT_THAT(problem_of(alone), HasSubstr("case.toml:7:1: region \"upper\": block around (2, 2) (it lies on both sides of fault "
                                             "\"main\", which ends inside it)"));
    // Beyond the fault that it meets it is left out, and the part before it is cut.
    const std::string held = without_region + "[[fault]]\nname = \"cross\"\npoints = [[2, -1], [2, 5]]\n";
    EXPECT_THAT(all_warnings(held), ElementsAre(HasSubstr("(0.5 m end inside a block")));
    EXPECT_EQ(generate_rock_mass(case_of(held)).blocks.size(), 6u);
}

TEST(Regions, WhatCannotBeCutIsRefused)
{
    const auto with_points = [](const std::string& points)
    { return problem_of(test::with(two_halves, "[[-1, 2], [5, 2]]", points)); };
    EXPECT_THAT(with_points("[[5, 5], [6, 7]]"),
                HasSubstr("case.toml:5:10: fault \"main\": points: from (5, 5) to (6, 7) (the fault lies "
                          "outside the domain, which spans (0, 0) to (4, 4)). Move it."));
    EXPECT_THAT(with_points("[[1, 1], [1, 1], [3, 2]]"), HasSubstr("points 0 and 1 are the same"));
    EXPECT_THAT(with_points("[[0, 0], [3, 3], [3, 0], [0, 3]]"), HasSubstr("the stretches from points 0 and 2 meet"));
    EXPECT_THAT(with_points("[[0, 0], [3, 3], [1, 1]]"), HasSubstr("the stretches from points 0 and 1 meet"));
    EXPECT_THAT(with_points("[[1, -1], [2, 2], [1, 5]]"),
                HasSubstr("region \"upper\": above = \"main\" (the fault ends straight above"));
    EXPECT_THAT(with_points("[[1, 1], [3, 1], [3, 3], [2, 3], [2, 2]]"), HasSubstr("(the fault winds"));
    EXPECT_THAT(with_points("[[-1, 2], [5, 2], [5, 2.000005], [-2, 2.000005]]"), HasSubstr("a sliver of "));
    const auto with_polygon = [](const std::string& polygon)
    { return problem_of(test::with(lens, "[[1, 1], [3, 1], [3, 3], [1, 3]]", polygon)); };
    EXPECT_THAT(with_polygon("[[1, 1], [3, 3], [3, 1], [1, 3]]"), HasSubstr("region \"lens\": polygon: edges 0 and 2 meet"));
    EXPECT_THAT(with_polygon("[[5, 5], [6, 5], [6, 6]]"),
                HasSubstr("region \"lens\": blocks = 0 (nothing of the domain lies in it)"));
}

TEST(Regions, KeysAreChecked)
{
    const auto problems = [](const std::string& text, const std::string& old, const std::string& by)
    { return testing::PrintToString(test::problems_of(test::with(text, old, by))); };
    EXPECT_THAT(problems(two_halves, "[[-1, 2], [5, 2]]", "[[-1, 2]]"), HasSubstr("has 1 points, a line has at least 2"));
    EXPECT_THAT(problems(two_halves, "above = \"main\"", "above = \"mian\""),
                HasSubstr("(no fault has this name; did you mean 'main'?)"));
    EXPECT_THAT(problems(two_halves, "region = \"upper\"", "region = \"uper\""), HasSubstr("did you mean 'upper'?"));
    EXPECT_THAT(problems(two_halves, "joint = \"fault\"", "joint = \"falut\""), HasSubstr("did you mean 'fault'?"));
    EXPECT_THAT(problems(lens, "material = \"shale\"\njoint", "material = \"slate\"\njoint"),
                HasSubstr("no material has this name"));
    EXPECT_THAT(problems(two_halves, "above = \"main\"", "above = \"main\"\njoint = \"fault\""),
                HasSubstr("belongs to polygon, which is not given"));
    EXPECT_THAT(problem_of(test::with(two_halves, "above = \"main\"\n", "")),
                HasSubstr("region \"upper\": polygon, above and below (none is given)"));
    EXPECT_THAT(test::problems_of(test::two_blocks + "[[fault]]\nname = \"f\"\npoints = [[0, 0], [1, 1]]\n"),
                ElementsAre(HasSubstr("[[fault]] (cuts the domain only, and there is no [domain])")));
}
}  // namespace
}  // namespace hdem
