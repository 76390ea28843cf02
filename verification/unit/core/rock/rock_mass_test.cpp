#include "core/rock/joint_sets.h"
#include "core/rock/rock_mass.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
TEST(RockMass, WithoutJointsIsOneBlock)
{
    const RockMass rock = generate_rock_mass(jointed_case(4.0, 3.0, {}));
    ASSERT_EQ(rock.blocks.size(), 1u);
    EXPECT_EQ(rock.blocks[0].name, "b1");
    EXPECT_DOUBLE_EQ(area(rock.blocks[0]), 12.0);
    EXPECT_NEAR(moments(rock.blocks[0]).polar, 12.0 * 25.0 / 12.0, 1e-13);
}

TEST(RockMass, OfTwoOrthogonalSetsIsAGridOfEqualBlocks)
{
    CaseDef def = jointed_case(6.0, 4.0, {{0.0, 1.0}, {90.0, 1.5}});
    def.joint_sets[0].deviation_deg = def.joint_sets[1].deviation_deg = 0.0;
    const RockMass rock = generate_rock_mass(def);
    ASSERT_EQ(rock.blocks.size(), 16u);
    for (const RockBlock& block : rock.blocks)
    {
        EXPECT_NEAR(area(block), 1.5, 1e-14);
        EXPECT_EQ(block.parts[0].vertices.size(), 4u);
    }
    expect_sound(rock);
}

TEST(RockMass, ConservesAreaForEverySeedAndIsTheSameTwice)
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        SCOPED_TRACE(seed);
        const CaseDef def = tunnel_case(seed, InsideOutline::jointed);
        const RockMass rock = generate_rock_mass(def);
        expect_sound(rock);
        EXPECT_TRUE(identical(rock, generate_rock_mass(def)));
        EXPECT_GE(rock.blocks.size(), 400u);
        EXPECT_LE(rock.blocks.size(), 600u);
    }
}

TEST(RockMass, DiffersBetweenSeeds)
{
    const auto rock = [](std::uint64_t seed) { return generate_rock_mass(tunnel_case(seed, InsideOutline::jointed)); };
    EXPECT_FALSE(identical(rock(1), rock(2)));
}

TEST(RockMass, HasNoBlockBelowTheSmallestAreaAndCountsRefusals)
{
    CaseDef def = jointed_case(35.0, 33.0, {{-10.0, 1.7}, {70.0, 1.7}, {-75.0, 3.5}});
    const RockMass all = generate_rock_mass(def);
    EXPECT_EQ(all.refused_cuts, 0);
    EXPECT_EQ(static_cast<std::int64_t>(all.blocks.size()), all.cuts + 1) << "every cut of a convex block adds one";
    def.generator.smallest_block_area = 0.363;
    const RockMass some = generate_rock_mass(def);
    EXPECT_GT(some.refused_cuts, 0);
    EXPECT_EQ(static_cast<std::int64_t>(some.blocks.size()), some.cuts + 1);
    EXPECT_LT(some.blocks.size(), all.blocks.size());
    for (const RockBlock& block : some.blocks)
    {
        EXPECT_GE(area(block), 0.363);
    }
    expect_sound(some);
}

TEST(RockMass, WarnsOfASetThatIsRefusedMostOfItsCuts)
{
    CaseDef def = jointed_case(35.0, 33.0, {{-10.0, 1.7}, {70.0, 1.7}});
    for (const auto& [least, is_told] : {std::pair(0.6, false), std::pair(8.0, true)})
    {
        def.generator.smallest_block_area = least;
        const RockMass rock = generate_rock_mass(def);
        ASSERT_EQ(rock.warnings.size(), is_told ? 1u : 0u) << least;
        EXPECT_GT(rock.refused_cuts, 0);
        if (!is_told)
            continue;
        EXPECT_EQ(rock.warnings[0].key, "joint_set[1]");
        EXPECT_THAT(rock.warnings[0].text, testing::HasSubstr(" cuts of blocks were refused ("));
    }
}

TEST(RockMass, WarnsOfCellsLargerThanTheDomain)
{
    CaseDef def = jointed_case(35.0, 33.0, {});
    def.voronoi.given = true;
    for (const auto& [edge, is_told] : {std::pair(34.0, false), std::pair(36.0, true)})
    {
        def.voronoi.edge = edge;
        const RockMass rock = generate_rock_mass(def);
        ASSERT_EQ(rock.warnings.size(), is_told ? 1u : 0u) << edge;
        for (const Problem& warning : rock.warnings)
            EXPECT_THAT(warning.text, testing::HasSubstr("edge = 36 m (a cell is larger than the whole domain)"));
    }
}

TEST(RockMass, HasNoEdgeBelowTheSmallestEdge)
{
    CaseDef def = jointed_case(35.0, 33.0, {{0.0, 1.9}, {60.0, 1.9}, {120.0, 1.9}});
    def.generator.smallest_edge = 0.05;
    const RockMass rock = generate_rock_mass(def);
    EXPECT_GT(rock.refused_cuts, 0);
    for (const DirectedEdge& edge : all_edges(rock))
    {
        EXPECT_GE((edge.to - edge.from).norm(), 0.05);
    }
    expect_sound(rock);
}

TEST(RockMass, CutsTheShareOfBlocksThatPersistenceSays)
{
    for (const double persistence : {0.9, 0.5})
    {
        CaseDef def = jointed_case(120.0, 120.0, {{10.0, 2.0}, {80.0, 2.0}});
        def.joint_sets[1].persistence = persistence;
        const RockMass rock = generate_rock_mass(def);
        JointSetDef first = def.joint_sets[0];
        CaseDef only_first = def;
        only_first.joint_sets = {first};
        const auto cuts = static_cast<double>(rock.cuts - generate_rock_mass(only_first).cuts);
        const double draws = cuts + static_cast<double>(rock.skipped_cuts);
        ASSERT_GT(draws, 1000.0);
        // Five standard deviations of a binomial distribution: one seed in 1.7 million would miss.
        EXPECT_NEAR(cuts / draws, persistence, 5.0 * std::sqrt(persistence * (1.0 - persistence) / draws));
        expect_sound(rock);
    }
}

TEST(RockMass, KeepsJointTracesWhenPersistenceChanges)
{
    CaseDef def = jointed_case(20.0, 20.0, {{10.0, 2.0}});
    const RockMass full = generate_rock_mass(def);
    def.joint_sets[0].persistence = 0.999999;
    EXPECT_TRUE(identical(full, generate_rock_mass(def)));
}

TEST(RockMass, InAConcaveDomainHasBlocksAcrossThePartsBoundaries)
{
    CaseDef def = jointed_case(0.0, 0.0, {{15.0, 1.3}, {80.0, 1.7}});
    def.domain.polygon = {{0, 0}, {20, 0}, {20, 6}, {12, 8}, {8, 16}, {0, 16}};
    const RockMass rock = generate_rock_mass(def);
    expect_sound(rock);
    EXPECT_NEAR(rock.domain_area, signed_area(def.domain.polygon), 1e-12);
    // No block is left that a joint crosses: parts were cut by the joints that reach any of them.
    for (std::size_t set = 0; set < 2; ++set)
    {
        const JointTraces joints = draw_joints(def.joint_sets[set], static_cast<std::int32_t>(set), def.generator,
                                               bounding_box(def.domain.polygon));
        for (const RockBlock& block : rock.blocks)
        {
            for (const CutLine& line : joints.lines)
            {
                for (const ConvexPart& part : block.parts)
                {
                    EXPECT_NE(side_of(part.vertices, line, 1e-8), Side::crossed) << block.name;
                }
            }
        }
    }
    // The parts of the domain must not show: only blocks at the reflex corner need more than one part.
    std::size_t several = 0;
    for (const RockBlock& block : rock.blocks)
    {
        several += block.parts.size() > 1 ? 1 : 0;
    }
    EXPECT_LE(several, 2u);
    EXPECT_GT(rock.blocks.size(), 60u);
}

TEST(RockMass, InAConcaveDomainIsCutAsIfThereWereNoParts)
{
    // Persistence and refusals decide block by block: the parts of a block must be cut together.
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        SCOPED_TRACE(seed);
        CaseDef def = jointed_case(0.0, 0.0, {{15.0, 1.3}, {80.0, 1.7}, {-40.0, 2.1}}, seed);
        def.domain.polygon = {{0, 0}, {30, 0}, {30, 25}, {20, 25}, {20, 5}, {10, 7}, {11, 25}, {0, 25}};
        def.joint_sets[2].persistence = 0.6;
        def.generator.smallest_block_area = 0.2;
        const RockMass rock = generate_rock_mass(def);
        expect_sound(rock);
        EXPECT_GT(rock.skipped_cuts, 0);
        for (const RockBlock& block : rock.blocks)
        {
            EXPECT_GE(area(block), 0.2);
        }
    }
}

TEST(RockMass, SplitsAlongAJointThatRunsOnTheBoundaryOfTheDomainsParts)
{
    // The L's convex parts meet along y = 1, between (0, 1) and (1, 1).
    CaseDef def = jointed_case(0.0, 0.0, {{0.0, 1.0}, {90.0, 1.0}});
    def.domain.polygon = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1}};
    for (JointSetDef& set : def.joint_sets)
    {
        set.deviation_deg = 0.0;
        set.origin = Vec2(0.0, 0.0);
    }
    const RockMass rock = generate_rock_mass(def);
    EXPECT_EQ(rock.blocks.size(), 4u);
    expect_sound(rock);
    for (const DirectedEdge& edge : all_edges(rock))
    {
        EXPECT_NE(edge.source, static_cast<std::int32_t>(edge_internal));
    }
}

TEST(RockMass, FarFromTheOriginConservesAreaToTheDigitsOfItsCoordinates)
{
    CaseDef def = tunnel_case(3, InsideOutline::jointed);
    def.domain.origin = {1.0e6, -2.0e6};
    def.excavations[0].position += def.domain.origin;
    const RockMass rock = generate_rock_mass(def);
    // Coordinates are multiples of 2.3e-10 m there; some 600 blocks with edges of 1.7 m.
    EXPECT_NEAR(summed_area(rock), rock.domain_area, 600.0 * 1.7 * 2.3e-10);
    EXPECT_NEAR(static_cast<double>(rock.blocks.size()),
                static_cast<double>(generate_rock_mass(tunnel_case(3, InsideOutline::jointed)).blocks.size()), 0.0);
}

/// Also those inside of an excavation: they would fall out of the model before they are removed.
TEST(FixedSides, HoldTheBlocksWithAnEdgeThereAndNoOthers)
{
    for (const auto& [floor, inside] : {std::pair(12.5, InsideOutline::jointed), std::pair(0.0, InsideOutline::jointed),
                                        std::pair(0.0, InsideOutline::one_block)})
    {
        CaseDef def = tunnel_case(1, inside);
        def.excavations[0].position.y() = floor;
        const RockMass rock = generate_rock_mass(def);
        std::size_t fixed = 0, fixed_inside = 0;
        for (const RockBlock& block : rock.blocks)
        {
            bool at_side = false;
            for (const ConvexPart& part : block.parts)
            {
                for (std::size_t i = 0; i < part.vertices.size(); ++i)
                {
                    const Vec2& a = part.vertices[i];
                    const Vec2& b = part.vertices[next(i, part.vertices.size())];
                    at_side = at_side || (a.x() == 0.0 && b.x() == 0.0) || (a.x() == 35.0 && b.x() == 35.0) ||
                              (a.y() == 0.0 && b.y() == 0.0);
                }
            }
            EXPECT_EQ(block.fix_x, at_side) << block.name;
            EXPECT_EQ(block.fix_y, at_side);
            EXPECT_EQ(block.fix_rotation, at_side);
            fixed += at_side ? 1 : 0;
            fixed_inside += at_side && block.excavation == 0 ? 1 : 0;
        }
        EXPECT_GT(fixed, 40u);
        EXPECT_LT(fixed, 120u);
        EXPECT_EQ(fixed_inside > 0, floor == 0.0);
    }
}

TEST(BlockNames, OfAWholeInsideAreNotThoseOfOthers)
{
    CaseDef def = tunnel_case(1, InsideOutline::one_block);
    def.excavations[0].name = "b99999";
    EXPECT_NO_THROW((void)generate_rock_mass(def));
    def.excavations[0].name = "b7";
    try
    {
        (void)generate_rock_mass(def);
        ADD_FAILURE() << "two blocks are called b7";
    }
    catch (const InputError& error)
    {
        EXPECT_EQ(error.problems()[0].key, "excavation[0].name");
    }
}

TEST(FixedSides, OfAPolygonAreCountedInTheOrderGiven)
{
    CaseDef def = jointed_case(0.0, 0.0, {{0.0, 1.0}});
    def.joint_sets[0].deviation_deg = 0.0;
    def.joint_sets[0].origin = Vec2(0.0, 0.0);
    def.domain.fixed_edges = {2};
    const auto fixed = [&def]
    {
        std::vector<bool> out;
        for (const RockBlock& block : generate_rock_mass(def).blocks)
        {
            out.push_back(block.fix_x);
        }
        return out;
    };
    def.domain.polygon = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
    EXPECT_EQ(fixed(), (std::vector<bool>{false, false, true})) << "edge 2 is the top";
    def.domain.polygon = {{0, 0}, {0, 3}, {4, 3}, {4, 0}};
    EXPECT_EQ(fixed(), (std::vector<bool>{true, true, true})) << "edge 2 is the right side";
    def.domain.polygon = {{4, 3}, {4, 0}, {0, 0}, {0, 3}};
    EXPECT_EQ(fixed(), (std::vector<bool>{true, true, true})) << "edge 2 is the left side";
    def.domain.polygon = {{4, 0}, {0, 0}, {0, 3}, {4, 3}};
    EXPECT_EQ(fixed(), (std::vector<bool>{false, false, true})) << "edge 2 is the top";
}

TEST(ExplicitBlocks, AreDecomposedAndKeepWhatTheUserSaid)
{
    CaseDef def;
    BlockDef block;
    block.name = "hook";
    block.polygon = {{0, 2}, {1, 2}, {1, 1}, {3, 1}, {3, 0}, {0, 0}};  // clockwise
    block.material = "steel";
    block.fix_y = true;
    block.velocity = {1.0, 2.0};
    block.angular_velocity = 3.0;
    def.blocks = {block};
    const RockMass rock = generate_rock_mass(def);
    ASSERT_EQ(rock.blocks.size(), 1u);
    EXPECT_EQ(rock.blocks[0].parts.size(), 2u);
    EXPECT_DOUBLE_EQ(area(rock.blocks[0]), 4.0);
    EXPECT_EQ(rock.blocks[0].material, "steel");
    EXPECT_FALSE(rock.blocks[0].fix_x);
    EXPECT_TRUE(rock.blocks[0].fix_y);
    EXPECT_EQ(rock.blocks[0].velocity, Vec2(1.0, 2.0));
    EXPECT_EQ(rock.blocks[0].angular_velocity, 3.0);
    EXPECT_EQ(rock.domain_area, 0.0);
    expect_edges_wholly_internal_or_external(rock);
}
}  // namespace
}  // namespace hdem
