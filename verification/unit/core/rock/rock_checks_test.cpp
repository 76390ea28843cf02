#include "core/rock/rock_checks.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
using testing::HasSubstr;

std::vector<Problem> problems_of(const CaseDef& def)
{
    try
    {
        static_cast<void>(generate_rock_mass(def));
    }
    catch (const InputError& error)
    {
        return error.problems();
    }
    return {};
}

void expect_problem(const CaseDef& def, const std::string& key, const std::string& part_of_text)
{
    const std::vector<Problem> problems = problems_of(def);
    ASSERT_EQ(problems.size(), 1u) << key;
    EXPECT_EQ(problems[0].key, key);
    EXPECT_EQ(problems[0].severity, Problem::Severity::error);
    EXPECT_THAT(problems[0].text, HasSubstr(part_of_text));
}

BlockDef square(const std::string& name, const Vec2& low, double side = 1.0)
{
    BlockDef block;
    block.name = name;
    block.polygon = {low, low + Vec2(side, 0.0), low + Vec2(side, side), low + Vec2(0.0, side)};
    return block;
}

CaseDef blocks_case(const std::vector<BlockDef>& blocks)
{
    CaseDef def;
    def.blocks = blocks;
    return def;
}

TEST(RockChecks, AcceptAGoodCase)
{
    EXPECT_TRUE(problems_of(tunnel_case(1, InsideOutline::jointed)).empty());
    EXPECT_TRUE(problems_of(blocks_case({square("a", {0, 0}), square("b", {1, 0})})).empty()) << "blocks may touch";
}

TEST(RockChecks, NameTheCrossingEdgesOfAPolygon)
{
    BlockDef bow = square("bow", {0, 0});
    std::swap(bow.polygon[2], bow.polygon[3]);
    expect_problem(blocks_case({square("a", {5, 5}), bow}), "block[1].polygon", "edges 1 and 3 meet at (0.5, 0.5)");
    CaseDef def = jointed_case(0.0, 0.0, {});
    def.domain.polygon = bow.polygon;
    expect_problem(def, "domain.polygon", "edges 1 and 3");
}

TEST(RockChecks, RefusePolygonsWithoutArea)
{
    BlockDef block = square("a", {0, 0});
    block.polygon.resize(2);
    expect_problem(blocks_case({block}), "block[0].polygon", "vertices = 2");
    block.polygon.resize(25'001);
    expect_problem(blocks_case({block}), "block[0].polygon", "vertices = 25001 (at most 25000)");
    block.polygon = {{0, 0}, {1, 1}, {2, 2}};
    expect_problem(blocks_case({block}), "block[0].polygon", "area = 0");
    block.polygon = {{0, 0}, {1, 0}, {std::nan(""), 1}};
    expect_problem(blocks_case({block}), "block[0].polygon", "vertex 2 = (nan, 1)");
}

TEST(RockChecks, NameBothBlocksThatOverlapAndTheArea)
{
    expect_problem(blocks_case({square("lower", {0, 0}), square("upper", {0.5, 0.75})}), "block[1].polygon",
                   "block \"upper\": polygon overlaps block \"lower\" by 0.125 m2");
    expect_problem(blocks_case({square("outer", {0, 0}, 4.0), square("inner", {1, 1})}), "block[1].polygon", "by 1 m2");
}

TEST(RockChecks, RefuseABlockInTheGeneratedMassUnlessItTouches)
{
    CaseDef def = jointed_case(10.0, 5.0, {});
    def.blocks = {square("top", {2.0, 5.0})};
    EXPECT_TRUE(problems_of(def).empty());
    def.blocks = {square("top", {2.0, 4.9})};
    expect_problem(def, "block[0].polygon", "overlaps block \"b1\" by 0.1 m2");
}

TEST(RockChecks, RefuseANameTwice)
{
    expect_problem(blocks_case({square("a", {0, 0}), square("a", {3, 0})}), "block[1].name", "\"a\"");
    CaseDef def = jointed_case(10.0, 5.0, {});
    def.blocks = {square("b1", {2.0, 5.0})};
    expect_problem(def, "block[0].name", "\"b1\"");
}

TEST(RockChecks, ReportAllProblemsAtOnce)
{
    CaseDef def = jointed_case(-1.0, std::numeric_limits<double>::infinity(), {{0.0, 0.0}});
    def.joint_sets[0].persistence = 1.5;
    def.joint_sets[0].deviation_deg = 90.0;
    def.generator.smallest_edge = -1.0;
    std::vector<std::string> keys;
    for (const Problem& problem : problems_of(def))
    {
        keys.push_back(problem.key);
    }
    EXPECT_THAT(keys,
                testing::UnorderedElementsAre("generator.smallest_edge", "domain.width", "domain.height", "joint_set[0].spacing",
                                              "joint_set[0].persistence", "joint_set[0].deviation_deg"));
}

TEST(RockChecks, RefuseUnknownFixedSidesAndEdges)
{
    CaseDef def = jointed_case(4.0, 3.0, {});
    def.domain.fixed = {"left", "lower"};
    expect_problem(def, "domain.fixed", "\"lower\"");
    def.domain.fixed = {};
    def.domain.fixed_edges = {3, 4};
    expect_problem(def, "domain.fixed_edges", "fixed_edges = 4");
}

TEST(RockChecks, RefuseADomainTooSmall)
{
    CaseDef def = jointed_case(1.0, 1.0, {});
    def.generator.smallest_block_area = 2.0;
    expect_problem(def, "domain", "area = 1 m2");
}

TEST(RockChecks, RefuseSpacingsThatMakeMoreBlocksThanMemoryHolds)
{
    const CaseDef def = jointed_case(1000.0, 1000.0, {{0.0, 0.01}, {90.0, 0.01}});
    expect_problem(def, "joint_set[0].spacing", "blocks");
}

TEST(RockChecks, RefuseBadExcavations)
{
    CaseDef def = tunnel_case(1, InsideOutline::jointed);
    def.excavations[0].width = -9.0;
    expect_problem(def, "excavation[0].width", "width = -9");
    def = tunnel_case(1, InsideOutline::jointed);
    def.excavations[0].height = 4.5;
    expect_problem(def, "excavation[0].height", "height = 4.5");
    def = tunnel_case(1, InsideOutline::jointed);
    def.excavations[0].arc_segments = 1;
    expect_problem(def, "excavation[0].arc_segments", "arc_segments = 1");
    def = tunnel_case(1, InsideOutline::jointed);
    def.excavations[0].position = {17.5, 40.0};
    expect_problem(def, "excavation[0].position", "outside the domain");
    def.domain.given = false;
    expect_problem(def, "excavation[0]", "no [domain]");
}

TEST(RockChecks, RefuseAnExcavationSwallowedByAnEarlierOne)
{
    CaseDef def = tunnel_case(1, InsideOutline::jointed);
    def.excavations.push_back(def.excavations[0]);
    def.excavations[1].name = "niche";
    def.excavations[1].shape = OutlineShape::rectangle;
    def.excavations[1].position = {17.5, 13.0};
    def.excavations[1].width = def.excavations[1].height = 1.0;
    expect_problem(def, "excavation[1]", "nothing is left");
}

TEST(RockChecks, RefuseOneBlockThatDoesNotHangTogether)
{
    CaseDef def = tunnel_case(1, InsideOutline::one_block);
    ExcavationDef drift = def.excavations[0];
    drift.name = "drift";
    drift.shape = OutlineShape::rectangle;
    drift.position = {17.5, 15.0};
    drift.width = 15.0;
    drift.height = 1.0;
    def.excavations.push_back(drift);
    expect_problem(def, "excavation[1].inside", "2 separate areas");
}

TEST(RockChecks, WarnOfAJointSetThatCutsNothing)
{
    CaseDef def = jointed_case(4.0, 3.0, {{0.0, 10.0}});
    def.joint_sets[0].origin = Vec2(2.0, -4.0);
    def.joint_sets[0].deviation_deg = 0.0;
    const RockMass rock = generate_rock_mass(def);
    ASSERT_EQ(rock.warnings.size(), 1u);
    EXPECT_EQ(rock.warnings[0].key, "joint_set[0]");
}

TEST(FindOverlaps, AgreesWithAllPairs)
{
    std::vector<RockBlock> blocks;
    for (int i = 0; i < 60; ++i)
    {
        CaseDef def = blocks_case({square("s", {0.37 * (i * 7 % 13), 0.41 * (i * 5 % 11)}, 0.5 + 0.01 * i)});
        blocks.push_back(generate_rock_mass(def).blocks[0]);
    }
    std::size_t pairs = 0;
    double common = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
        for (std::size_t a = 0; a < b; ++a)
        {
            const double overlap = overlap_area(blocks[a].parts[0].vertices, blocks[b].parts[0].vertices);
            pairs += overlap > 1e-6 * std::min(area(blocks[a]), area(blocks[b])) ? 1 : 0;
            common += overlap;
        }
    }
    double found = 0.0;
    const auto overlaps = find_overlaps(blocks, 0, 1e-6);
    for (const BlockOverlap& overlap : overlaps)
    {
        found += overlap.area;
    }
    EXPECT_GT(pairs, 50u);
    EXPECT_EQ(overlaps.size(), pairs);
    EXPECT_NEAR(found, common, 1e-9);
}
}  // namespace
}  // namespace hdem
