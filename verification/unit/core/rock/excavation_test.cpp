#include "verification/unit/core/rock/excavation_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hdem
{
namespace
{
using test::area_inside;
using test::excavation;
using test::rock_case;

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
}  // namespace
}  // namespace hdem
