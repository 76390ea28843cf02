#include "core/rock/excavation.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hdem
{
namespace
{
ExcavationDef excavation(const std::string& name, OutlineShape shape, const Vec2& position, double width, double height)
{
    ExcavationDef def;
    def.name = name;
    def.shape = shape;
    def.position = position;
    def.width = width;
    def.height = height;
    def.diameter = width;
    return def;
}

CaseDef rock_case(std::uint64_t seed = 1)
{
    return jointed_case(20.0, 18.0, {{-10.0, 1.7}, {70.0, 1.7}, {-75.0, 3.5}}, seed);
}

double area_inside(const RockMass& rock, Index number)
{
    double sum = 0.0;
    for (const RockBlock& block : rock.blocks)
    {
        sum += block.excavation == number ? area(block) : 0.0;
    }
    return sum;
}

/// Centroids of inside parts lie in the outline, those of others outside.
void expect_separated(const RockMass& rock, const Polygon& outline, Index number)
{
    for (const RockBlock& block : rock.blocks)
    {
        for (const ConvexPart& part : block.parts)
        {
            const double common = overlap_area(part.vertices, outline);
            EXPECT_NEAR(common, block.excavation == number ? signed_area(part.vertices) : 0.0, 1e-11) << block.name;
        }
    }
}

TEST(Outline, OfAHorseshoeIsARectangleUnderAHalfCircleOfStraightEdges)
{
    ExcavationDef def = excavation("t", OutlineShape::horseshoe, {3.0, -2.0}, 9.0, 8.0);
    def.arc_segments = 16;
    const Polygon outline = outline_polygon(def);
    EXPECT_EQ(outline.size(), 19u);  // two feet, and 17 vertices of the arc
    EXPECT_TRUE(is_convex(outline));
    const double arc = 16.0 / 2.0 * 4.5 * 4.5 * std::sin(std::numbers::pi / 16.0);
    EXPECT_NEAR(signed_area(outline), 9.0 * 3.5 + arc, 1e-13);
    const Box box = bounding_box(outline);
    EXPECT_EQ(box.low, Vec2(-1.5, -2.0));
    EXPECT_EQ(box.high, Vec2(7.5, 6.0));
}

TEST(Outline, OfCircleRectangleAndPolygonIsTheirs)
{
    ExcavationDef circle = excavation("c", OutlineShape::circle, {1.0, 1.0}, 2.0, 0.0);
    circle.arc_segments = 12;
    EXPECT_EQ(outline_polygon(circle).size(), 12u);
    EXPECT_NEAR(signed_area(outline_polygon(circle)), 3.0, 1e-14);  // the dodecagon of radius 1 has area 3
    EXPECT_NEAR(signed_area(outline_polygon(excavation("r", OutlineShape::rectangle, {0.0, 0.0}, 3.0, 2.0))), 6.0, 1e-15);
    ExcavationDef polygon;
    polygon.polygon = {{0, 0}, {0, 1}, {1, 0}};
    EXPECT_DOUBLE_EQ(signed_area(outline_polygon(polygon)), 0.5);
}

TEST(Excavation, OfJointedRockKeepsItsJointsAndItsArea)
{
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
    {
        SCOPED_TRACE(seed);
        const CaseDef def = tunnel_case(seed, InsideOutline::jointed);
        const RockMass rock = generate_rock_mass(def);
        const Polygon outline = outline_polygon(def.excavations[0]);
        EXPECT_NEAR(area_inside(rock, 0), signed_area(outline), 1e-11);
        expect_separated(rock, outline, 0);
        expect_sound(rock);
        std::size_t inside = 0;
        for (const RockBlock& block : rock.blocks)
        {
            if (block.excavation == 0)
            {
                EXPECT_EQ(block.name, "tunnel." + std::to_string(++inside));
                EXPECT_FALSE(block.fix_x);
            }
        }
        EXPECT_GT(inside, 20u);
    }
}

TEST(Excavation, AsOneBlockHasTheOutlinesVerticesAndName)
{
    const CaseDef def = tunnel_case(1, InsideOutline::one_block);
    const RockMass rock = generate_rock_mass(def);
    const Polygon outline = outline_polygon(def.excavations[0]);
    const RockBlock& block = rock.blocks.back();
    EXPECT_EQ(block.name, "tunnel");
    ASSERT_EQ(block.parts.size(), 1u) << "a convex outline is one part";
    EXPECT_TRUE(
        std::is_permutation(outline.begin(), outline.end(), block.parts[0].vertices.begin(), block.parts[0].vertices.end()));
    for (const std::int32_t source : block.parts[0].source)
    {
        EXPECT_EQ(source, static_cast<std::int32_t>(edge_outline));
    }
    expect_separated(rock, outline, 0);
    expect_sound(rock);
}

TEST(Excavation, MarksTheWholeOutlineAndNothingElseAsOutline)
{
    const CaseDef def = tunnel_case(2, InsideOutline::jointed);
    const Polygon outline = outline_polygon(def.excavations[0]);
    double perimeter = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        perimeter += (outline[next(i, outline.size())] - outline[i]).norm();
    }
    double marked = 0.0;
    for (const DirectedEdge& edge : all_edges(generate_rock_mass(def)))
    {
        if (edge.source == edge_outline)
        {
            marked += (edge.to - edge.from).norm();
            EXPECT_LT(distance_to_boundary(outline, 0.5 * (edge.from + edge.to)), 1e-9);
        }
    }
    EXPECT_NEAR(marked, 2.0 * perimeter, 1e-9) << "both sides";
}

TEST(Excavation, OfAConcaveOutlineIsSound)
{
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
    {
        for (const InsideOutline inside : {InsideOutline::jointed, InsideOutline::one_block})
        {
            SCOPED_TRACE(seed);
            CaseDef def = rock_case(seed);
            def.generator.smallest_block_area = 0.2;
            ExcavationDef cross;
            cross.name = "cross";
            cross.inside = inside;
            cross.polygon = {{5, 7},   {8, 7},   {8, 4},   {11, 4}, {11, 7}, {14, 7},
                             {14, 10}, {11, 10}, {11, 13}, {8, 13}, {8, 10}, {5, 10}};
            def.excavations = {cross};
            const RockMass rock = generate_rock_mass(def);
            EXPECT_NEAR(area_inside(rock, 0), 45.0, 1e-11);
            expect_separated(rock, cross.polygon, 0);
            expect_sound(rock);
        }
    }
}

TEST(Excavation, InsideASingleBlockLeavesARing)
{
    CaseDef def = jointed_case(10.0, 10.0, {});
    def.excavations = {excavation("hole", OutlineShape::circle, {5.0, 5.0}, 4.0, 0.0)};
    const RockMass rock = generate_rock_mass(def);
    ASSERT_EQ(rock.blocks.size(), 2u);
    EXPECT_GT(rock.blocks[0].parts.size(), 2u);
    expect_separated(rock, outline_polygon(def.excavations[0]), 0);
    expect_edges_wholly_internal_or_external(rock);
    EXPECT_NEAR(summed_area(rock), 100.0, 1e-11);
}

TEST(Excavation, TooSmallToBeCutIsRefusedForThat)
{
    CaseDef def = jointed_case(10.0, 8.0, {{-10.0, 2.0}});
    def.excavations = {excavation("hole", OutlineShape::rectangle, {5.0, 3.0}, 1e-9, 1e-9)};
    try
    {
        generate_rock_mass(def);
        ADD_FAILURE() << "it was cut";
    }
    catch (const InputError& error)
    {
        EXPECT_NE(std::string(error.what()).find("too small to be cut"), std::string::npos) << error.what();
    }
}

TEST(Excavation, MayCutABlockIntoSeveralOutside)
{
    CaseDef def = jointed_case(10.0, 10.0, {});
    def.excavations = {excavation("trench", OutlineShape::rectangle, {5.0, -1.0}, 2.0, 12.0)};
    const RockMass rock = generate_rock_mass(def);
    ASSERT_EQ(rock.blocks.size(), 3u);
    EXPECT_NEAR(area_inside(rock, 0), 20.0, 1e-13);
    EXPECT_EQ(rock.blocks[0].name, "b1");
    EXPECT_EQ(rock.blocks[1].name, "b2");
    EXPECT_EQ(rock.blocks[2].name, "trench.1");
}

TEST(Excavation, AlongJointsCutsNothing)
{
    CaseDef def = jointed_case(6.0, 6.0, {{0.0, 1.0}, {90.0, 1.0}});
    def.joint_sets[0].deviation_deg = def.joint_sets[1].deviation_deg = 0.0;
    def.excavations = {excavation("room", OutlineShape::rectangle, {3.0, 2.0}, 2.0, 2.0)};
    const RockMass rock = generate_rock_mass(def);
    EXPECT_EQ(rock.blocks.size(), 36u);
    EXPECT_NEAR(area_inside(rock, 0), 4.0, 1e-13);
    expect_sound(rock);
}

TEST(Excavation, OpenToTheSurfaceIsCutWhereTheDomainIs)
{
    for (const InsideOutline inside : {InsideOutline::jointed, InsideOutline::one_block})
    {
        CaseDef def = rock_case();
        def.domain.fixed = {"top"};
        ExcavationDef cut = excavation("cut", OutlineShape::rectangle, {10.0, 12.0}, 5.0, 10.0);
        cut.inside = inside;
        def.excavations = {cut};
        const RockMass rock = generate_rock_mass(def);
        EXPECT_NEAR(area_inside(rock, 0), 5.0 * 6.0, 1e-11);
        expect_sound(rock);
        const auto is_held_inside = [](const RockBlock& block) { return block.fix_x && block.excavation == 0; };
        EXPECT_TRUE(std::ranges::any_of(rock.blocks, is_held_inside)) << "the side holds what is to be excavated, too";
    }
}

TEST(Excavation, WithVerticesOnJointsSharesThemToTheLastBit)
{
    // The circle's leftmost and rightmost vertices lie on a joint, where they are computed in more than one way.
    for (int i = 0; i < 20; ++i)
    {
        CaseDef def = jointed_case(10.0, 10.0, {{0.0, 1.0}, {90.0, 1.0}});
        def.joint_sets[0].deviation_deg = def.joint_sets[1].deviation_deg = 0.0;
        def.joint_sets[1].persistence = 0.7;
        ExcavationDef first = excavation("first", OutlineShape::circle, {4.0, 5.0}, 3.1 + 0.07 * i, 0.0);
        ExcavationDef second = excavation("second", OutlineShape::circle, {7.0, 5.0}, 3.3 + 0.05 * i, 0.0);
        first.inside = second.inside = InsideOutline::one_block;
        def.excavations = {first, second};
        expect_sound(generate_rock_mass(def));
    }
}

TEST(Excavations, ThatOverlapLeaveTheCommonAreaToTheFirst)
{
    for (const InsideOutline inside : {InsideOutline::jointed, InsideOutline::one_block})
    {
        CaseDef def = rock_case(3);
        ExcavationDef first = excavation("first", OutlineShape::rectangle, {8.0, 5.0}, 6.0, 6.0);
        ExcavationDef second = excavation("second", OutlineShape::rectangle, {12.0, 6.0}, 6.0, 6.0);
        first.inside = second.inside = inside;
        def.excavations = {first, second};
        const RockMass rock = generate_rock_mass(def);
        EXPECT_NEAR(area_inside(rock, 0), 36.0, 1e-11);
        EXPECT_NEAR(area_inside(rock, 1), 36.0 - 2.0 * 5.0, 1e-11);
        expect_sound(rock);
    }
}

TEST(Excavations, ThatOverlapAreWarnedOfIfTheSecondIsRemovedFirst)
{
    CaseDef def = jointed_case(20.0, 18.0, {});
    def.excavations = {excavation("one", OutlineShape::rectangle, {8.0, 8.0}, 4.0, 4.0),
                       excavation("two", OutlineShape::rectangle, {11.0, 9.0}, 4.0, 2.0)};
    for (const bool is_told : {false, true})
    {
        def.stages = {{.name = "a"}, {.name = "b"}};
        def.stages[0].excavate = {is_told ? "two" : "one"};
        def.stages[1].excavate = {is_told ? "one" : "two"};
        const RockMass rock = generate_rock_mass(def);
        ASSERT_EQ(rock.warnings.size(), is_told ? 1u : 0u);
        if (is_told)
        {
            EXPECT_NE(rock.warnings[0].text.find("excavation \"two\": 2 m2 of it lie in \"one\""), std::string::npos)
                << rock.warnings[0].text;
        }
    }
}

TEST(Excavations, ThatTouchShareTheirBoundary)
{
    CaseDef def = rock_case(4);
    def.generator.smallest_block_area = 0.3;
    def.excavations = {excavation("heading", OutlineShape::rectangle, {10.0, 8.0}, 6.0, 3.0),
                       excavation("bench", OutlineShape::rectangle, {10.0, 5.0}, 6.0, 3.0)};
    const RockMass rock = generate_rock_mass(def);
    EXPECT_NEAR(area_inside(rock, 0), 18.0, 1e-11);
    EXPECT_NEAR(area_inside(rock, 1), 18.0, 1e-11);
    expect_sound(rock);
}

TEST(Slivers, AreJoinedToANeighbourOnTheirSideOfTheOutline)
{
    // A grid of 1 m, and a floor 0.05 m above a row of joints: 0.05 m² pieces lie outside, below the floor.
    CaseDef def = jointed_case(6.0, 6.0, {{0.0, 1.0}, {90.0, 1.0}});
    def.joint_sets[0].deviation_deg = def.joint_sets[1].deviation_deg = 0.0;
    def.excavations = {excavation("room", OutlineShape::rectangle, {3.0, 2.05}, 2.0, 1.95)};
    EXPECT_EQ(generate_rock_mass(def).blocks.size(), 38u);
    def.generator.smallest_block_area = 0.1;
    const RockMass rock = generate_rock_mass(def);
    EXPECT_EQ(rock.merged_slivers, 2);
    EXPECT_EQ(rock.blocks.size(), 36u);
    EXPECT_NEAR(area_inside(rock, 0), 3.9, 1e-13);
    std::size_t joined = 0;
    for (const RockBlock& block : rock.blocks)
    {
        EXPECT_GE(area(block), 0.1);
        // The blocks below the floor take the slivers over their whole upper edges: both are rectangles of 1 m x 1.05 m.
        joined += std::abs(area(block) - 1.05) < 1e-12 ? 1 : 0;
    }
    EXPECT_EQ(joined, 2u);
    expect_sound(rock);
    EXPECT_TRUE(rock.warnings.empty());
}

/// Far from the origin, coordinates are rounded to 1e-11 m. Sides that are straight there stay whole when slivers are joined to blocks.
TEST(Slivers, LeaveTheSameEdgesFarFromTheOrigin)
{
    const auto vertices = [](std::uint64_t seed, const Vec2& by)
    {
        CaseDef def = jointed_case(0.0, 0.0, {{-4.4, 1.9}, {-72.7, 2.7}, {55.0, 3.1}}, seed);
        def.domain.polygon = {by + Vec2(-9, -8), by + Vec2(9, -8), by + Vec2(9, 8), by + Vec2(-9, 8)};
        for (JointSetDef& set : def.joint_sets)
            set.origin = by + Vec2(0.31, 0.17 * static_cast<double>(seed));
        def.generator.smallest_block_area = 0.2;
        def.excavations = {excavation("ex", OutlineShape::circle, by + Vec2(0.1, -0.2), 5.2, 5.2)};
        std::vector<std::size_t> counts;
        for (const RockBlock& block : generate_rock_mass(def).blocks)
            for (const ConvexPart& part : block.parts)
                counts.push_back(part.vertices.size());
        return counts;
    };
    int alike = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        for (const double by : {0.1, 3e4, 1e5})
            alike += vertices(seed, {by, by}) == vertices(seed, {0.0, 0.0}) ? 1 : 0;
    EXPECT_EQ(alike, 60) << "without slack 24";
}

/// The parts around a hole end at corners alone: no side is in two pieces.
TEST(Excavation, LeavesTheSidesOfTheBlockAroundItWhole)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 60; ++i)
    {
        CaseDef def = jointed_case(0.0, 0.0, {});
        def.domain.polygon = {{0, 0}, {12, 0}, {12, 9}, {7, 9}, {6, 8}, {0, 9}};
        std::size_t sides = def.domain.polygon.size();
        for (const Vec2& centre : {Vec2(3.0, 4.0), Vec2(8.5, 4.5)})
        {
            ExcavationDef hole = excavation("hole" + std::to_string(def.excavations.size()), OutlineShape::polygon, {0, 0}, 0.0,
                                            0.0);
            hole.inside = InsideOutline::one_block;
            const int corners = 3 + static_cast<int>(6.0 * share(random));
            for (int k = 0; k < corners; ++k)
            {
                const double angle = 2.0 * std::numbers::pi * (k + 0.5 * share(random)) / corners,
                             radius = 0.5 + 2.0 * share(random);
                hole.polygon.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
            }
            sides += hole.polygon.size();
            def.excavations.push_back(hole);
        }
        const RockMass rock = generate_rock_mass(def);
        expect_sound(rock);
        ASSERT_EQ(rock.blocks.size(), 3u);
        std::size_t found = 0;
        for (const ConvexPart& part : rock.blocks[0].parts)
            found += static_cast<std::size_t>(
                std::ranges::count_if(part.source, [](std::int32_t source) { return source != edge_internal; }));
        EXPECT_EQ(found, sides) << i;
    }
}

/// Cuts and joined slivers leave internal edges in concave blocks. None of these parts a straight side, whichever cut came first.
TEST(Slivers, LeaveTheSameEdgesInAMirroredModel)
{
    const auto outer_edges = [](std::uint64_t seed, double sign)
    {
        CaseDef def = jointed_case(0.0, 0.0, {{-4.4, 1.9}, {-72.7, 2.7}, {55.0, 3.1}});
        def.domain.polygon = {{-9, -8}, {9, -8}, {9, 8}, {-9, 8}};
        for (JointSetDef& set : def.joint_sets)
        {
            set.dip_deg *= sign;
            set.deviation_deg = 0.0;
            set.origin = Vec2(sign * 0.31, 0.17 * static_cast<double>(seed));
        }
        def.generator.smallest_block_area = 0.2;
        def.excavations = {excavation("ex", OutlineShape::circle, {sign * 0.1, -0.2}, 5.2, 5.2)};
        std::vector<std::size_t> counts;
        for (const RockBlock& block : generate_rock_mass(def).blocks)
        {
            counts.push_back(0);
            for (const ConvexPart& part : block.parts)
                counts.back() += static_cast<std::size_t>(
                    std::ranges::count_if(part.source, [](std::int32_t source) { return source != edge_internal; }));
        }
        std::ranges::sort(counts);
        return counts;
    };
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        EXPECT_EQ(outer_edges(seed, 1.0), outer_edges(seed, -1.0)) << seed;
}

TEST(Slivers, LeaveNoBlockBelowTheSmallestAreaAroundATunnel)
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        const RockMass rock = generate_rock_mass(tunnel_case(seed, InsideOutline::one_block));
        double least = 1e9;
        for (const RockBlock& block : rock.blocks)
        {
            least = std::min(least, area(block));
        }
        EXPECT_GT(rock.merged_slivers, 0);
        for (const Problem& warning : rock.warnings)
            EXPECT_NE(warning.text.find("cuts of blocks were refused"), std::string::npos) << warning.text;
        EXPECT_GE(least, 0.363);
        EXPECT_NEAR(least * 2700.0, 979.0, 0.05 * 979.0) << "the smallest block of the published model";
    }
}

TEST(Slivers, WithoutANeighbourOnTheirSideStayWithAWarning)
{
    CaseDef def = jointed_case(10.0, 10.0, {});
    def.generator.smallest_block_area = 1.0;
    def.excavations = {excavation("niche", OutlineShape::rectangle, {5.0, 5.0}, 0.5, 0.5)};
    const RockMass rock = generate_rock_mass(def);
    EXPECT_EQ(rock.merged_slivers, 0);
    ASSERT_EQ(rock.warnings.size(), 1u);
    EXPECT_EQ(rock.warnings[0].key, "excavation[0]");
    EXPECT_EQ(rock.warnings[0].severity, Problem::Severity::warning);
    EXPECT_EQ(rock.blocks.size(), 2u);
}
}  // namespace
}  // namespace hdem
