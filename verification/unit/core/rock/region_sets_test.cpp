#include "core/rock/build_model.h"
#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gmock/gmock.h>

#include <set>

namespace hdem
{
namespace
{
using test::areas;
using test::case_of;
using test::laws;
using test::square;
using test::two_halves;
using testing::ElementsAre;

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
