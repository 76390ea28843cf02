#include "verification/unit/case_run.h"
#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <random>

namespace hdem
{
namespace
{
using test::case_of;
using test::CaseRun;
using test::laws;
using test::lens;
using test::square;
using test::two_halves;
using testing::ElementsAre;
using testing::HasSubstr;

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

/// Layers of a map: the outline of one runs along those of two others, whatever their order. No sliver is left between them, and nothing is dropped.
TEST(Regions, RunAlongSeveralOthersInAnyOrder)
{
    const std::map<std::string, std::string> outlines = {{"left", "[[0, 2], [1.5, 2.45], [1.5, 4], [0, 4]]"},
                                                         {"right", "[[1.5, 2.45], [4, 3.2], [4, 4], [1.5, 4]]"},
                                                         {"lower", "[[0, 0], [4, 0], [4, 3.2], [0, 2]]"}};
    const std::string beds = "[[joint_set]]\ndip_deg = 16.69924423399362\nspacing = 0.5\norigin = [0, 2]\n"
                             "[[joint_set]]\ndip_deg = 90.0\nspacing = 1.0\norigin = [1.5, 0]\n";
    std::vector<std::string> order = {"left", "lower", "right"};
    do
        for (const double turn_deg : {0.0, 23.0, 45.0, 61.0, -60.0, 137.0})
            for (const std::string& sets : {std::string(), beds})
            {
                std::string text = square;
                for (const std::string& name : order)
                    text += "[[region]]\nname = \"" + name + "\"\npolygon = " + outlines.at(name) + "\n";
                SCOPED_TRACE(text + fmt::format("turned by {}", turn_deg));
                const RockMass rock = generate_rock_mass(case_of(text + sets + laws, turn_deg));
                expect_sound(rock);
                EXPECT_TRUE(rock.warnings.empty()) << rock.warnings[0].text;
                if (sets.empty())
                {
                    EXPECT_THAT(areas(rock, "rock"), ElementsAre(2.6625, 2.9375, 10.4));
                }
                for (const RockBlock& block : rock.blocks)
                    EXPECT_GT(area(block), 1e-3);
            }
    while (std::ranges::next_permutation(order).found);
}

/// An outline that runs along another one for a part of its edge goes on from its corner.
TEST(Regions, GoOnFromTheCornersOfOthers)
{
    const auto text = [](const char* first, const char* second)
    {
        return square +
               fmt::format("[[region]]\nname = \"one\"\npolygon = {}\n[[region]]\nname = \"two\"\npolygon = {}\n", first, second) +
               laws;
    };
    const char *const small = "[[1, 1], [2, 1], [2, 2], [1, 2]]", *const beside = "[[2, 0.5], [3, 0.5], [3, 3], [2, 3]]",
                      *const across = "[[1.5, 2], [3, 2], [3, 3], [1.5, 3]]";
    for (double turn_deg = 0.0; turn_deg < 180.0; turn_deg += 15.25)
        for (const auto& [first, second, area_of_second] : {std::tuple(small, beside, 2.5), std::tuple(beside, small, 1.0),
                                                            std::tuple(small, across, 1.5), std::tuple(across, small, 1.0)})
        {
            SCOPED_TRACE(fmt::format("{} {} turned by {}", first, second, turn_deg));
            const RockMass rock = generate_rock_mass(case_of(text(first, second), turn_deg));
            expect_sound(rock);
            const double area_of_first = first == small ? 1.0 : (first == beside ? 2.5 : 1.5);
            std::vector<double> expected = {area_of_first, area_of_second, 16.0 - area_of_first - area_of_second};
            std::ranges::sort(expected);
            EXPECT_THAT(areas(rock, "rock"), testing::ElementsAreArray(expected));
            EXPECT_TRUE(rock.warnings.empty()) << rock.warnings[0].text;
        }
}

/// Faults typed with a few digits lie almost along joints of a set. A cut that leaves nothing on one side is none.
TEST(Regions, BesideJointsAlmostAlongFaultsHaveAreas)
{
    const std::string sets = "[[joint_set]]\ndip_deg = 0.0\nspacing = 0.5\norigin = [0, 0]\n"
                             "[[joint_set]]\ndip_deg = 90.0\nspacing = 1.0\norigin = [0, 0]\n";
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i)
    {
        const double off = std::pow(10.0, -9.0 + 6e-10 * static_cast<double>(random())), turn = 3.0 * i;
        const std::string text = square + fmt::format("[[fault]]\nname = \"a\"\npoints = [[-1, 1.5], [5, {}]]\n", 1.5 + off) +
                                 fmt::format("[[fault]]\nname = \"b\"\npoints = [[-1, {}], [5, {}]]\n", 2.5 + off, 2.5 - off) +
                                 sets + laws;
        SCOPED_TRACE(text + fmt::format("turned by {}", turn));
        const RockMass rock = generate_rock_mass(case_of(text, turn));
        for (const RockBlock& block : rock.blocks)
            EXPECT_GT(area(block), 1e-12) << block.name;
        EXPECT_NEAR(summed_area(rock), 16.0, 1e-9);
    }
}

/// Two faults meet on the side of the domain within a rounding. An edge of a rounding between them would give next to no time step, and blocks around an island lost a corner there.
TEST(Regions, BesideFaultsThatMeetAlmostInAPointLoseNoArea)
{
    for (const double off : {0.0, 1e-15, 1e-13, 1e-11, 1e-9})
        for (const double turn : {0.0, 31.0, 90.0})
        {
            const std::string text = "[domain]\npolygon = [[0, 0], [16, 0], [16, 12], [0, 12]]\n"
                                     "[[fault]]\nname = \"a\"\npoints = [[-4, 6.2], [17, 16.7]]\n" +
                                     fmt::format("[[fault]]\nname = \"b\"\npoints = [[-1, {}], [17, 13.3]]\n", 7.9 + off) +
                                     "[[region]]\nname = \"r\"\npolygon = [[10, 1], [11, 1.1], [11, 2], [10.2, 2]]\n"
                                     "[[joint_set]]\ndip_deg = 26\nspacing = 20\norigin = [8, 4]\n" +
                                     laws;
            const RockMass rock = generate_rock_mass(case_of(text, turn));
            EXPECT_NEAR(summed_area(rock), 192.0, 1e-7) << off << ", turned by " << turn;
            for (const RockBlock& block : rock.blocks)
            {
                EXPECT_TRUE(moments(block).centroid.allFinite()) << block.name;
                for (const ConvexPart& part : block.parts)
                    for (std::size_t i = 0; i < part.vertices.size(); ++i)
                        EXPECT_GT((part.vertices[next(i, part.vertices.size())] - part.vertices[i]).norm(), 1e-9) << block.name;
            }
        }
}

/// Islands in a block beside a bent fault are found in any orientation.
TEST(Regions, LieAsIslandsInABlock)
{
    for (const double turn : {0.0, 31.0, 90.0, 180.0, 270.0})
    {
        const RockMass rock = generate_rock_mass(
            case_of("[domain]\npolygon = [[0, 0], [16, 0], [16, 14], [0, 14]]\n"
                    "[[fault]]\nname = \"f\"\npoints = [[-1, 10], [13, 5], [17, 10]]\n"
                    "[[region]]\nname = \"r0\"\nmaterial = \"shale\"\npolygon = [[12, 2], [13, 3], [12, 5]]\n"
                    "[[region]]\nname = \"r1\"\nmaterial = \"shale\"\n"
                    "polygon = [[2, 3], [3, 4], [2, 5], [1, 4]]\n" +
                        laws,
                    turn));
        EXPECT_EQ(rock.blocks.size(), 4u) << turn;
        EXPECT_NEAR(summed_area(rock), 224.0, 1e-9) << turn;
        EXPECT_THAT(areas(rock, "shale"), ElementsAre(testing::DoubleNear(1.5, 1e-6), testing::DoubleNear(2.0, 1e-6))) << turn;
    }
}

/// Three sets without origin meet in the middle of the domain within a rounding. The stretches between them were edges, and a block, of a rounding.
TEST(Regions, BesideSetsThroughOnePointHaveNoEdgesOfARounding)
{
    const auto set = [](double dip, double spacing, const std::string& more)
    { return fmt::format("[[joint_set]]\ndip_deg = {}\nspacing = {}\n{}\n", dip, spacing, more); };
    const auto island = [](int number, double x, double y, double a)
    {
        return fmt::format("[[region]]\nname = \"r{0}\"\npolygon = [[{1}, {2}], [{3}, {2}], [{3}, {4}], [{1}, {4}]]\n", number, x,
                           y, x + a, y + a);
    };
    const RockMass rock = generate_rock_mass(case_of(
        "[domain]\nwidth = 22\nheight = 23.8\n[generator]\nseed = 280\n" + set(70.7, 11.0, "") + set(-42.5, 10.4, "") +
        set(9.8, 12.1, "") + set(-1.6, 8.0, "trace = 7.6\ngap = 2.3") + set(46.5, 3.9, "persistence = 0.95\norigin = [6.6, 8.8]") +
        island(0, 16.9, 14.2, 1.2) + island(1, 7.8, 7.1, 1.0) + island(2, 11.0, 2.1, 1.4) + island(3, 3.2, 18.7, 1.4) + laws));
    EXPECT_NEAR(summed_area(rock), 22.0 * 23.8, 1e-7);
    for (const RockBlock& block : rock.blocks)
    {
        EXPECT_GT(area(block), 1e-6) << block.name;
        for (const ConvexPart& part : block.parts)
            for (std::size_t i = 0; i < part.vertices.size(); ++i)
                EXPECT_GT((part.vertices[next(i, part.vertices.size())] - part.vertices[i]).norm(), 1e-9) << block.name;
    }
}

/// The inside of an excavation as one block may lie across a boundary. Its parts follow the cuts, and the largest of them need not be in what most of it is in.
TEST(Regions, GiveABlockAcrossThemTheMaterialOfItsGreatestArea)
{
    for (const int sign : {1, -1})
    {
        const auto polygon = [&](const std::vector<Vec2>& points)
        {
            std::string text;
            for (const Vec2& p : points)
                text += fmt::format("{}[{}, {}]", text.empty() ? "[" : ", ", sign * p.x(), p.y());
            return text + "]";
        };
        const std::string text = "[domain]\npolygon = " + polygon({{0, 0}, {11, 0}, {11, 10}, {0, 10}}) +
                                 "\n[[region]]\nname = \"soft\"\nmaterial = \"shale\"\npolygon = " +
                                 polygon({{3, 3.6}, {6, 3.6}, {6, 7}, {3, 6}}) +
                                 "\n[[joint_set]]\ndip_deg = 90\nspacing = 60\norigin = [" + std::to_string(sign) + ", 1]\n" +
                                 "[[excavation]]\nname = \"e\"\nshape = \"polygon\"\ninside = \"one_block\"\npolygon = " +
                                 polygon({{4, 2}, {7, 2}, {7, 3}, {5, 3}, {5, 5}, {4, 5}}) + "\n" + laws;
        const RockMass rock = generate_rock_mass(case_of(text));
        EXPECT_EQ(rock.blocks.back().name, "e");
        EXPECT_EQ(rock.blocks.back().material, "rock") << "1.4 of its 5 m2 are in the shale";
    }
}

/// A side that is the region's outline and then the excavation's faces one edge of the excavation as one block. Each of its two edges has a part, and so a contact:
/// stressed rock is in balance.
TEST(Regions, BearAlongTheWholeOfASideOfTwoOutlines)
{
    CaseDef def = case_of("[domain]\npolygon = [[0, 0], [11, 0], [11, 10], [0, 10]]\nhold = \"mean\"\n"
                          "[[region]]\nname = \"r\"\npolygon = [[2, 4], [5, 4], [5, 5], [3, 5], [3, 7], [2, 7]]\n"
                          "[[joint_set]]\ndip_deg = 90\nspacing = 2\norigin = [3, 3]\n"
                          "[[excavation]]\nname = \"e\"\nshape = \"polygon\"\ninside = \"one_block\"\n"
                          "polygon = [[4, 2], [7, 2], [7, 3], [5, 3], [5, 5], [4, 5]]\n" +
                          laws +
                          "[gravity]\nvector = [0, 0]\n[insitu]\nstress = [-3e6, -2e6, 3e5]\n"
                          "[[boundary]]\nedges = [0, 1, 2, 3]\nkind = \"stress\"\nstress = \"insitu\"\n");
    CaseRun run(def);
    run.advance(20);
    for (Index b = 0; b < run.model().blocks(); ++b)
        EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-12) << run.model().name[b];
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

const std::string fault_below_a_hole = R"([domain]
width = 10.0
height = 9.0
[[fault]]
name = "main"
points = [[-1, 4], [11, 4]]
joint = "fault"
)";

/// A circle comes close to a fault. A sliver between them has its longest edge on the fault, but also a neighbour on its own side.
TEST(Regions, AreNotKeyedThroughAFaultByTheSliversOfAnExcavation)
{
    const RockMass rock = generate_rock_mass(case_of(fault_below_a_hole + R"([[joint_set]]
name = "upright"
dip_deg = 90.0
spacing = 1.6
origin = [5.3, 4.0]
[generator]
smallest_block_area = 0.06
[[excavation]]
name = "hole"
shape = "circle"
position = [5, 5.5]
diameter = 3.0
arc_segments = 16
inside = "one_block"
)" + laws));
    expect_sound(rock);
    EXPECT_EQ(rock.merged_slivers, 1);
    EXPECT_TRUE(rock.warnings.empty());
    for (const RockBlock& block : rock.blocks)
    {
        double low = 9.0, high = 0.0;
        for (const ConvexPart& part : block.parts)
            for (const Vec2& v : part.vertices)
            {
                low = std::min(low, v.y());
                high = std::max(high, v.y());
            }
        EXPECT_TRUE(low > 3.99 || high < 4.01) << low << " to " << high;
    }
}

TEST(Regions, TakeSliversAcrossAFaultWhereThereIsNoOtherNeighbour)
{
    const RockMass rock = generate_rock_mass(case_of(fault_below_a_hole + R"([generator]
smallest_block_area = 1.0
[[excavation]]
name = "slot"
shape = "rectangle"
position = [5, 4.05]
width = 12.0
height = 3.0
)" + laws));
    EXPECT_EQ(rock.merged_slivers, 1);
    ASSERT_EQ(rock.warnings.size(), 1U);
    EXPECT_THAT(rock.warnings[0].text, HasSubstr("no neighbour but across a fault"));
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

/// Of each set the screen says what became of its joints: those of a region count within it alone.
TEST(Regions, WhatWasNotCutIsKnownBySet)
{
    const auto sets = [](const std::string& more)
    {
        return generate_rock_mass(
                   case_of(square + "[[region]]\nname = \"left\"\npolygon = [[0, 0], [1, 0], [1, 4], [0, 4]]\n" +
                           "[[joint_set]]\nname = \"a\"\ndip_deg = 0\nspacing = 0.5\norigin = [0, 0.25]\nregion = \"left\"\n" +
                           "[[joint_set]]\nname = \"b\"\ndip_deg = 90\nspacing = 0.5\norigin = [0.25, 0]\n" + more + laws))
            .sets;
    };
    const std::vector<DrawnSet> whole = sets("");
    EXPECT_NEAR(whole[0].length, 8.0, 1e-9) << "eight joints of 1 m";
    EXPECT_NEAR(whole[1].length, 32.0, 1e-9);
    EXPECT_EQ(whole[0].skipped + whole[0].refused + whole[1].skipped + whole[1].refused, 0.0);

    const std::vector<DrawnSet> some = sets("persistence = 0.5\n");
    EXPECT_GT(some[1].skipped, 6.0);
    EXPECT_LT(some[1].skipped, 26.0);
    EXPECT_EQ(some[0].skipped, 0.0);

    const std::vector<DrawnSet> few = sets("[generator]\nsmallest_block_area = 0.24\n");
    EXPECT_NEAR(few[0].refused, 0.0, 1e-9);
    EXPECT_NEAR(few[1].refused, 8.0, 1e-9) << "the two joints of the region, whose blocks have 0.5 m2";
    EXPECT_NEAR(few[1].length, 32.0, 1e-9);
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
}  // namespace
}  // namespace hdem
