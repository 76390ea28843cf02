#include "verification/unit/core/rock/excavation_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::area_inside;
using test::excavation;
using test::rock_case;

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
}  // namespace
}  // namespace hdem
