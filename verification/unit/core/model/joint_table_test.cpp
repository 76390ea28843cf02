#include "core/geometry/convex_part.h"
#include "core/model/model.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
/// Laws: 0 default, 1 of joint set 1, 2 between materials 0 and 1. Set 0 has none of its own.
JointTable table()
{
    JointTable joints;
    joints.names = {"default", "bedding", "lining"};
    joints.laws.resize(3);
    joints.of_joint_set = {no_index, 1};
    joints.materials = 2;
    joints.of_materials = {0, 2, 2, 0};
    return joints;
}

TEST(JointTable, GivesTheJointSetsLawBeforeTheMaterials)
{
    const JointTable joints = table();
    EXPECT_EQ(joints.find(1, 1, 0, 1), 1);
    EXPECT_EQ(joints.find(1, edge_plain, 0, 0), 1);
    EXPECT_EQ(joints.find(edge_outline, 1, 0, 0), 1);
}

/// Which block's edge is the reference is chance: the law must not depend on it.
TEST(JointTable, GivesTheFirstOfTwoSetsLawsInEitherOrder)
{
    JointTable joints = table();
    joints.of_joint_set = {no_index, 1, 2};
    EXPECT_EQ(joints.find(1, 2, 0, 0), 1);
    EXPECT_EQ(joints.find(2, 1, 0, 0), 1);
    EXPECT_EQ(joints.find(0, 2, 0, 0), 2) << "a set without a law of its own";
    EXPECT_EQ(joints.find(2, 0, 0, 0), 2);
}

TEST(JointTable, GivesTheMaterialPairsLawInEitherOrder)
{
    const JointTable joints = table();
    EXPECT_EQ(joints.find(edge_plain, edge_plain, 0, 1), 2);
    EXPECT_EQ(joints.find(edge_plain, edge_plain, 1, 0), 2);
    EXPECT_EQ(joints.find(0, 0, 1, 0), 2) << "a set without a law of its own";
}

TEST(JointTable, GivesTheDefaultOtherwise)
{
    const JointTable joints = table();
    EXPECT_EQ(joints.find(edge_plain, edge_outline, 0, 0), 0);
    EXPECT_EQ(joints.find(0, edge_plain, 1, 1), 0);
}

TEST(Model, FindsBlocksByNameAndKnowsTheirSize)
{
    Model model;
    model.name = {"a", "b"};
    model.area = {4.0, 0.25};
    EXPECT_EQ(model.find_block("b"), 1);
    EXPECT_EQ(model.find_block("c"), no_index);
    EXPECT_DOUBLE_EQ(model.size(0), 2.0);
}
}  // namespace
}  // namespace hdem
