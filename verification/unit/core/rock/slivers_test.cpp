#include "verification/unit/core/rock/excavation_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::area_inside;
using test::excavation;

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
