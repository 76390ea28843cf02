#include "core/joint/all_laws.h"
#include "core/rock/build_model.h"
#include "core/rock/strength_reduction.h"
#include "io/case_reader.h"
#include "verification/unit/core/joint/law_point.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
constexpr double factor = 1.7, stress = 4e5;

/// Table of a case with this joint as its default.
JointTable table_of(const std::string& joint)
{
    return build_model(read_case_text(R"(
[material.rock]
density = 2700.0
)" + joint + R"(
[[block]]
name = "ground"
polygon = [[-5, -1], [30, -1], [30, 0], [-5, 0]]
fixed = true
[[block]]
name = "block"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[stage]]
cycles = 10
)",
                                      "case.toml")
                           .def)
        .model.joints;
}

const std::string springs = "[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 2e10\n";
const std::string joints[] = {
    "friction_angle_deg = 30.0\ncohesion = 1e5\ntension = 1e4\nresidual_friction_angle_deg = 25.0\ndilation_angle_deg = 8.0\n",
    "law = \"barton_bandis\"\njrc = 10.0\njcs = 1e8\nresidual_friction_angle_deg = 28.0\nlength = 0.2\n",
    "law = \"patton\"\nfriction_angle_deg = 30.0\nasperity_angle_deg = 10.0\nresidual_friction_angle_deg = 33.0\ncohesion = 1e6\n",
    "law = \"continuously_yielding\"\nfriction_angle_deg = 30.0\nmobilised_angle_deg = 45.0\nwear_length = 2e-3\n",
    "law = \"plesha\"\nfriction_angle_deg = 30.0\nasperity_angle_deg = 12.0\nwear = 1e-6\n",
    "law = \"slip_weakening\"\nfriction_angle_deg = 35.0\nresidual_friction_angle_deg = 25.0\nwear_length = 1e-2\n",
    "law = \"saeb_amadei\"\nfriction_angle_deg = 30.0\nasperity_angle_deg = 12.0\ntransition_stress = 5e7\nrock_cohesion = "
    "5e6\nrock_friction_angle_deg = 40.0\ngreatest_closure = 3e-4\n"};

TEST(StrengthReduction, PeakStrengthOfEveryLawIsDivided)
{
    for (const std::string& joint : joints)
    {
        const JointTable table = table_of(springs + joint);
        const StageLaws reduced = reduced_laws(table, {.factor = factor});
        for (const double sigma : {1e4, 4e5, 6e6})
            EXPECT_NEAR(factor * peak_strength(reduced.rows[0], sigma), peak_strength(table.rows[0], sigma),
                        1e-12 * peak_strength(table.rows[0], sigma))
                << joint;
    }
}

/// Under a constant stress a joint that slips by 2 mm bears 1/F of what it bears with its whole strength, and opens as it did.
TEST(StrengthReduction, SlippingJointsBearTheirShareAndOpenAsBefore)
{
    for (const std::string& joint : joints)
    {
        const JointTable table = table_of(springs + joint);
        const StageLaws reduced = reduced_laws(table, {.factor = factor});
        with_law(table.rows[0].kind,
                 [&](auto law)
                 {
                     with_curve(table.rows[0].curve,
                                [&](auto curve)
                                {
                                    using Point = LawPoint<decltype(law), decltype(curve)>;
                                    Point whole(table.rows[0].numbers, stress), less(reduced.rows[0].numbers, stress);
                                    whole.go(2e-3, 4000, stress);
                                    less.go(2e-3, 4000, stress);
                                    EXPECT_NEAR(factor * less.now.shear, whole.now.shear, 0.01 * whole.now.shear) << joint;
                                    EXPECT_NEAR(less.now.opening, whole.now.opening, 0.05 * whole.now.opening + 2e-6) << joint;
                                });
                 });
    }
}

TEST(StrengthReduction, OfPlainJointsAndOfBlocksThatHaveMet)
{
    const JointTable table = table_of(springs + "friction_angle_deg = 30.0\ncohesion = 1e5\n");
    const StageLaws reduced = reduced_laws(table, {.factor = 2.0});
    EXPECT_DOUBLE_EQ(2.0 * reduced.laws[0].friction_coefficient, table.laws[0].friction_coefficient);
    EXPECT_DOUBLE_EQ(reduced.laws[0].cohesion, 5e4);
    const Index met = table.unbonded_of(0);
    ASSERT_NE(met, 0);
    EXPECT_DOUBLE_EQ(2.0 * reduced.laws[met].friction_coefficient, table.laws[met].friction_coefficient);
}

TEST(StrengthReduction, OnlyOfJointsThatAreNamed)
{
    const JointTable table = table_of(springs +
                                      "friction_angle_deg = 30.0\n[joint.bedding]\nnormal_stiffness = 1e10\nshear_stiffness = "
                                      "1e9\nfriction_angle_deg = 20.0\n");
    const StageLaws reduced = reduced_laws(table, {.factor = 2.0, .joints = {0, 1}});
    EXPECT_DOUBLE_EQ(reduced.laws[0].friction_coefficient, table.laws[0].friction_coefficient);
    EXPECT_DOUBLE_EQ(2.0 * reduced.laws[1].friction_coefficient, table.laws[1].friction_coefficient);
}

TEST(StrengthReduction, PeakStrengthThroughout)
{
    const std::string loses[] = {joints[0], joints[3], joints[4], joints[5], joints[6] + "residual_share = 0.5\n"};
    for (const std::string& joint : loses)
    {
        const JointTable table = table_of(springs + joint);
        EXPECT_TRUE(loses_strength(table, {})) << joint;
        JointTable peak = table;
        peak.rows = reduced_laws(table, {.keeps_peak = true}).rows;
        EXPECT_FALSE(loses_strength(peak, {})) << joint;
    }
    EXPECT_FALSE(loses_strength(table_of(springs + joints[2]), {}));
    EXPECT_FALSE(loses_strength(table_of(springs + "friction_angle_deg = 30.0\ncohesion = 1e5\n"), {}));
}

TEST(StrengthReduction, StifferJointsBearTheSameStressAtAThirdOfTheStrain)
{
    for (const std::string& joint : joints)
    {
        const JointTable table = table_of(springs + joint);
        const StageLaws stiff = reduced_laws(table, {.stiffness = 3.0});
        EXPECT_DOUBLE_EQ(stiff.laws[0].normal_stiffness, 3.0 * table.laws[0].normal_stiffness);
        for (const double sigma : {1e4, 4e5, 2e6})
            EXPECT_NEAR(3.0 * closure_under(stiff.rows[0], sigma), closure_under(table.rows[0], sigma),
                        1e-12 * closure_under(table.rows[0], sigma))
                << joint;
    }
}

TEST(StrengthReduction, DilationIsPaidForUpToAFactor)
{
    const JointTable table = table_of(springs + joints[0]);
    EXPECT_NEAR(greatest_factor_for_dilation(table, {}), std::tan(0.43633231299858238) / std::tan(0.13962634015954636), 1e-9);
    EXPECT_EQ(greatest_factor_for_dilation(table_of(springs + "friction_angle_deg = 30.0\n"), {}),
              std::numeric_limits<double>::infinity());
}
}  // namespace
}  // namespace hdem
