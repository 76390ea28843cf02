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
using test::areas;
using test::case_of;
using test::CaseRun;
using test::laws;
using test::lens;
using test::square;
using test::two_halves;
using testing::ElementsAre;

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
}  // namespace
}  // namespace hdem
