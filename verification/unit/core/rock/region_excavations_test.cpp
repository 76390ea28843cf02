#include "verification/unit/case_run.h"
#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::case_of;
using test::CaseRun;
using test::laws;
using test::two_halves;
using testing::HasSubstr;

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
}  // namespace
}  // namespace hdem
