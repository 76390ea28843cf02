#include "core/model/edge_sources.h"
#include "core/rock/finite_traces.h"
#include "core/rock/rock_mass.h"
#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gmock/gmock.h>

#include <cmath>

namespace hdem
{
namespace
{
using test::laws;
using testing::HasSubstr;

const std::string box_20 = "[domain]\nwidth = 20.0\nheight = 20.0\n";

RockMass rock_of(const std::string& text)
{
    return generate_rock_mass(test::read(text));
}

/// Every edge lies on the domain's boundary or faces other blocks along its whole length: the blocks fill the domain.
void expect_filled(const RockMass& rock)
{
    EXPECT_NEAR(summed_area(rock), rock.domain_area, 1e-9 * rock.domain_area);
    double common = 0.0;
    for (const BlockOverlap& overlap : find_overlaps(rock.blocks, 0, 0.0))
        common += overlap.area;
    EXPECT_LE(common, 1e-9 * rock.domain_area);
    for (const RockBlock& block : rock.blocks)
        for (const ConvexPart& part : block.parts)
            EXPECT_TRUE(is_convex(part.vertices, 1e-9)) << block.name;
}

const std::string two_sets = R"([[joint_set]]
name = "beds"
dip_deg = 5.0
spacing = 1.5
[[joint_set]]
name = "cross"
dip_deg = {mean = 80.0, distribution = "normal", sd = 6.0}
spacing = {mean = 1.2, distribution = "exponential", least = 0.3}
trace = {mean = 4.0, distribution = "lognormal", sd = 2.0}
gap = {mean = 1.0, distribution = "exponential"}
)";

TEST(FiniteTraces, CutTogetherWithThroughGoingSets)
{
    for (int seed = 1; seed < 6; ++seed)
    {
        SCOPED_TRACE(seed);
        const std::string text = box_20 + two_sets + "[generator]\nseed = " + std::to_string(seed) + "\n" + laws;
        const RockMass rock = rock_of(text);
        expect_filled(rock);
        EXPECT_GT(rock.blocks.size(), 60u);
        ASSERT_EQ(rock.sets.size(), 2u);
        EXPECT_EQ(rock.sets[0].dead_ends, 0.0) << "a through-going joint has none";
        EXPECT_GT(rock.sets[1].dead_ends, 0.0);
        EXPECT_LT(rock.sets[1].dead_ends, 0.6 * rock.sets[1].length);
        EXPECT_GT(rock.dead_ends, 0) << "they are counted, as those of a file are";
        EXPECT_TRUE(identical(rock, rock_of(text)));
    }
}

TEST(FiniteTraces, WhatIsLeftAndWhatIsDroppedIsAllThatWasDrawn)
{
    const CaseDef def = test::read(box_20 + two_sets + laws);
    const RockMass rock = generate_rock_mass(def);
    const std::int32_t source = EdgeSources(def).set(1);
    double edges = 0.0;  // each joint has two sides
    for (const DirectedEdge& edge : all_edges(rock))
        edges += edge.source == source ? (edge.to - edge.from).norm() : 0.0;
    const DrawnSet& set = rock.sets[1];
    EXPECT_NEAR(0.5 * edges + set.dead_ends + set.welded, set.length, 1e-3 * set.length);
}

TEST(FiniteTraces, HaveTheLengthAnAreaThatIsAskedFor)
{
    const std::string isotropic = R"([[joint_set]]
dip_deg = {distribution = "uniform", least = -90.0, most = 90.0}
p21 = 1.2
trace = 3.0
)";
    double length = 0.0;
    for (int seed = 1; seed <= 10; ++seed)
        length += rock_of("[domain]\nwidth = 60.0\nheight = 30.0\n" + isotropic + "[generator]\nseed = " + std::to_string(seed) +
                          "\n" + laws)
                      .sets[0]
                      .length;
    // 7200 traces: their number has a standard deviation of 85.
    EXPECT_NEAR(length / 18'000.0, 1.2, 3.0 * 1.2 / std::sqrt(7200.0));
}

TEST(FiniteTraces, OnLinesHaveTheLengthAnAreaOfTracesAndGaps)
{
    double length = 0.0;
    for (int seed = 1; seed <= 10; ++seed)
        length += rock_of("[domain]\nwidth = 60.0\nheight = 30.0\n[[joint_set]]\ndip_deg = 20.0\nspacing = 1.0\ntrace = 3.0\n"
                          "gap = 2.0\n[generator]\nseed = " +
                          std::to_string(seed) + "\n" + laws)
                      .sets[0]
                      .length;
    EXPECT_NEAR(length / 18'000.0, 0.6, 0.6 * 0.02);
}

TEST(FiniteTraces, AloneCloseAroundNothingAndLeaveOneBlock)
{
    const RockMass rock = rock_of(box_20 + "[[joint_set]]\ndip_deg = 30.0\nspacing = 1.0\ntrace = 2.0\ngap = 1.0\n" + laws);
    for (const RockBlock& block : rock.blocks)
        EXPECT_TRUE(rock.blocks.size() == 1 || area(block) > 0.0);
    EXPECT_GT(rock.sets[0].dead_ends, 0.9 * rock.sets[0].length);
}

const std::string fault = R"([[fault]]
name = "main"
points = [[-23, 5], [43, 17]]
joint = "fault"
)";

TEST(StopsAt, EndsJointsAtTheFault)
{
    const std::string set = "[[joint_set]]\nname = \"s\"\ndip_deg = 75.0\nspacing = 2.0\norigin = [10, 4]\n";
    const CaseDef def = test::read(box_20 + fault + set + "stops_at = [\"main\"]\n" + laws);
    const RockMass rock = generate_rock_mass(def);
    expect_filled(rock);
    const auto above = [](const Vec2& p) { return p.y() > 9.0 + (p.x() + 1.0) * 4.0 / 22.0 + 1e-3; };
    const std::int32_t source = EdgeSources(def).set(0);
    std::size_t below = 0;
    for (const DirectedEdge& edge : all_edges(rock))
        if (edge.source == source)
        {
            EXPECT_FALSE(above(edge.from) || above(edge.to));
            ++below;
        }
    EXPECT_GT(below, 10u);
    EXPECT_LT(rock.sets[0].dead_ends, 1e-3);
    EXPECT_GT(rock_of(box_20 + fault + set + laws).blocks.size(), rock.blocks.size()) << "without it they go on";
}

TEST(StopsAt, KeepsTheSideOfEachTracesMiddle)
{
    const CaseDef def = test::read(box_20 + fault + "[[joint_set]]\ndip_deg = 5.0\nspacing = 1.0\n" +
                                   "[[joint_set]]\nname = \"s\"\ndip_deg = 95.0\np21 = 1.0\ntrace = 4.0\nstops_at = [\"main\"]\n" +
                                   laws);
    std::vector<DrawnSet> drawn;
    for (const SourceLine& line : draw_lines(def, drawn))
        if (line.source == EdgeSources(def).set(1))
        {
            const auto side = [](const Vec2& p) { return p.y() - 9.0 - (p.x() + 1.0) * 4.0 / 22.0; };
            EXPECT_GT(side(line.points[0]) * side(line.points[1]), -1e-3) << "crosses by no more than it is made longer";
        }
    expect_filled(generate_rock_mass(def));
}

TEST(FiniteTraces, StayInTheirRegion)
{
    const CaseDef def = test::read(
        box_20 +
        "[[region]]\nname = \"zone\"\npolygon = [[4, 4], [15, 5], [16, 14], [5, 15]]\n"
        "[[joint_set]]\ndip_deg = 5.0\nspacing = 1.0\n"
        "[[joint_set]]\nname = \"s\"\ndip_deg = {mean = 80.0, distribution = \"von_mises\", kappa = 40.0}\n"
        "spacing = 1.0\ntrace = 5.0\ngap = 1.0\nregion = \"zone\"\n" +
        laws);
    const RockMass rock = generate_rock_mass(def);
    expect_filled(rock);
    std::size_t edges = 0;
    for (const DirectedEdge& edge : all_edges(rock))
        if (edge.source == EdgeSources(def).set(1))
        {
            ++edges;
            EXPECT_TRUE(contains(def.regions[0].polygon, 0.5 * (edge.from + edge.to)));
        }
    EXPECT_GT(edges, 50u);
    EXPECT_LT(rock.sets[1].length, 0.85 * 121.0) << "five sixths of the zone's area in metres, as it is drawn in the zone only";
}

TEST(FiniteTraces, CellsBelowTheSmallestAreaAreJoinedAndCounted)
{
    const std::string text = box_20 + two_sets + "[generator]\nsmallest_block_area = 0.3\n" + laws;
    const RockMass rock = rock_of(text);
    expect_filled(rock);
    for (const RockBlock& block : rock.blocks)
        EXPECT_GE(area(block), 0.3);
    EXPECT_GT(rock.merged_slivers, 0);
    EXPECT_GT(rock.sets[0].welded + rock.sets[1].welded, 0.0);
}

/// Two upright joints 10 cm from each other that stop at a fault, and one that ends at the same fault from the other side: the cell between
/// the two has an edge of 10 cm at the fault and one at the boundary. Beside the boundary both go straight on in the neighbour.
TEST(FiniteTraces, CellsWithShortEdgesAreJoinedToANeighbour)
{
    const std::string text = box_20 + "[[fault]]\nname = \"main\"\npoints = [[-1, 10], [21, 10]]\n"
                                      "[[joint_set]]\ndip_deg = 90.0\nspacing = 8.0\norigin = [5, 5]\nstops_at = [\"main\"]\n"
                                      "[[joint_set]]\ndip_deg = 90.0\nspacing = 8.0\norigin = [5.1, 5]\nstops_at = [\"main\"]\n";
    const auto shortest = [](const RockMass& rock)
    {
        double least = 1e9;
        for (const DirectedEdge& edge : all_edges(rock))
            least = std::min(least, (edge.to - edge.from).norm());
        return least;
    };
    const RockMass all = rock_of(text + laws);
    EXPECT_EQ(all.blocks.size(), 6u) << "three wide ones, two narrow ones below the fault, one above it";
    EXPECT_NEAR(shortest(all), 0.1, 1e-9);
    const RockMass joined = rock_of(text + "[generator]\nsmallest_edge = 0.3\n" + laws);
    expect_filled(joined);
    EXPECT_EQ(joined.blocks.size(), 4u);
    EXPECT_GT(shortest(joined), 0.3);
    EXPECT_EQ(joined.merged_slivers, 2);
    EXPECT_NEAR(joined.sets[0].welded + joined.sets[1].welded, 20.0, 1e-3);
    EXPECT_TRUE(std::ranges::none_of(joined.warnings, [](const Problem& p) { return p.key == "generator.smallest_edge"; }));
}

TEST(FiniteTraces, ShortEdgesThatAreLeftAreCounted)
{
    const std::string text = box_20 + two_sets + "[generator]\nsmallest_edge = 0.2\n" + laws;
    const RockMass rock = rock_of(text);
    expect_filled(rock);
    EXPECT_GT(rock.merged_slivers, 0);
    EXPECT_TRUE(std::ranges::any_of(
        rock.warnings, [](const Problem& p)
        { return p.key == "generator.smallest_edge" && p.text.find("shorter edges are left") != std::string::npos; }));
}

/// Round-off makes a triangle of the point, smaller than any block.
TEST(LinesThroughOnePoint, LeaveNoBlockBetweenThem)
{
    const auto set = [](double dip, double spacing)
    {
        return "[[joint_set]]\ndip_deg = " + std::to_string(dip) + "\nspacing = " + std::to_string(spacing) +
               "\norigin = [5.1, 4.7]\nstops_at = [\"far\"]\n";
    };
    for (int turn = 0; turn < 40; ++turn)
    {
        SCOPED_TRACE(turn);
        const RockMass rock = rock_of(
            "[domain]\nwidth = 10.0\nheight = 10.0\n[[fault]]\nname = \"far\"\npoints = [[-1, 9], [11, 9.5]]\n" +
            set(20.0 + turn, 3.0) + set(75.0 + turn, 4.0) + set(-50.0 + turn, 3.5) + laws);
        expect_filled(rock);
        for (const RockBlock& block : rock.blocks)
            EXPECT_GT(area(block), 1e-6) << block.name;
    }
}

TEST(DrawnSpacing, IsFoundByEveryBlock)
{
    const RockMass rock = rock_of(
        box_20 +
        "[[joint_set]]\ndip_deg = {mean = 15.0, distribution = \"normal\", sd = 5.0}\n"
        "spacing = {mean = 0.8, distribution = \"exponential\"}\n" +
        "[[joint_set]]\ndip_deg = 80.0\nspacing = {mean = 1.0, distribution = \"lognormal\", sd = 0.5}\n" + laws);
    expect_sound(rock);
    EXPECT_EQ(static_cast<std::int64_t>(rock.blocks.size()), rock.cuts + 1);
    EXPECT_GT(rock.sets[0].spacing.mean(), 0.5);
    // No block is left that a joint crosses.
    const CaseDef def = test::read(box_20 +
                                   "[[joint_set]]\ndip_deg = 80.0\n"
                                   "spacing = {mean = 1.0, distribution = \"lognormal\", sd = 0.5}\n" +
                                   laws);
    const RockMass one = generate_rock_mass(def);
    EXPECT_EQ(static_cast<std::int64_t>(one.blocks.size()), one.sets[0].joints + 1);
}
}  // namespace
}  // namespace hdem
