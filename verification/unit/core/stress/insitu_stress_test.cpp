#include "core/contact/contact_report.h"
#include "core/stress/insitu_stress.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

#include <numbers>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Rock between fixed sides.
CaseDef rock(const std::vector<double>& dips, const InsituDef& insitu)
{
    CaseDef scene = scenes::empty_scene();
    scene.domain = {.given = true, .width = 14.0, .height = 14.0, .fixed = {"left", "right", "bottom", "top"}};
    for (const double dip : dips)
        scene.joint_sets.push_back({.name = "dip" + std::to_string(dip), .dip_deg = dip, .spacing = 1.7});
    scene.generator.smallest_block_area = 0.02;
    scene.generator.smallest_edge = 0.02;
    scene.joints[0].friction_angle_deg = 50.0;
    scene.insitu = insitu;
    scene.insitu.given = true;
    scene.gravity = {0.0, 0.0};
    return scene;
}

/// Normal and shear stress of the long joints of one dip, at the height `y` for a stress that grows with depth.
void expect_stress(const CaseRun& run, double dip_deg, double normal, double shear)
{
    int found = 0;
    for (Index i = 0; i < run.state().contacts.size(); ++i)
    {
        if (!is_closed_contact(run.state(), i))
            continue;
        const ContactReport joint = report_contact(run.state(), i);
        const double dip = std::remainder(
            std::atan2(joint.shear_axis().y(), joint.shear_axis().x()) * 180.0 / std::numbers::pi - dip_deg, 180.0);
        if (std::abs(dip) > 1e-6 || joint.length < 0.1)
            continue;
        if (joint.normal_force == 0.0)  // two corners
            continue;
        ++found;
        EXPECT_NEAR(joint.normal_force / joint.length, normal, 1e-9 * normal);
        EXPECT_NEAR(std::abs(joint.shear_force) / joint.length, std::abs(shear), 1e-9 * normal);
    }
    EXPECT_GT(found, 20) << "dip " << dip_deg;
}

void expect_nothing_moves(CaseDef scene)
{
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        const InsituSummary summary = summarise_insitu(run.model(), run.state());
        EXPECT_LT(summary.unbalance, 1e-12);
        EXPECT_LT(summary.field, 1e-12);
        run.advance(1000);
        for (Index b = 0; b < run.model().blocks(); ++b)
        {
            EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-12) << run.model().name[b];
            EXPECT_LT(std::abs(run.state().blocks.motion[b].angle), 1e-12);
        }
    }
}

/// sigma_n = -n sigma n, tau = e sigma n by hand: for (-8, -5, 1) MPa dips of 0, 25, 60, 90 and -55 degrees.
/// Each law bears what it is drawn with: closures that are no straight line, Barton-Bandis with the displacement that its shear stress asks for.
TEST(InsituStress, IsHeldByEachJointLaw)
{
    for (JointDef joint : scenes::sample_joints())
    {
        CaseDef scene = rock({0.0, 60.0, -55.0}, {.stress = StressDef{-8e6, -5e6, 1e6}});
        scene.joints = {joint};
        for (const Method method : {Method::force, Method::hybrid})
        {
            scene.contact.method = method;
            CaseRun run(scene);
            EXPECT_LT(summarise_insitu(run.model(), run.state()).unbalance, 1e-12) << static_cast<int>(joint.law);
            run.advance(1000);
            for (Index b = 0; b < run.model().blocks(); ++b)
                EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-12) << static_cast<int>(joint.law);
        }
    }
}

TEST(InsituStress, IsThatOfTheFieldOnEveryJoint)
{
    const InsituDef field{.stress = StressDef{-8e6, -5e6, 1e6}};
    const double known[][3] = {{0.0, 5e6, 1e6},
                               {25.0, 6301863.028589169, 1791854.274365006},
                               {60.0, 8116025.403784439, 799038.1056766585},
                               {90.0, 8e6, -1e6},
                               {-55.0, 6073337.594202596, -1751559.074504532}};
    for (const auto& [dip, normal, shear] : known)
        expect_stress(CaseRun(rock({dip, dip > 0.0 ? dip - 80.0 : dip + 80.0}, field)), dip, normal, shear);
}

TEST(InsituStress, LeavesUniformRockWhereItIsDrawn)
{
    expect_nothing_moves(rock({25.0, -55.0, 90.0}, {.stress = StressDef{-8e6, -5e6, 1e6}}));
}

TEST(InsituStress, LeavesRockUnderTheGroundWhereItIsDrawn)
{
    CaseDef scene = rock({25.0, -55.0, 90.0}, {.surface = 14.0, .ratio = 1.5});
    scene.gravity = {0.0, -9.81};
    scene.domain.fixed = {"left", "right", "bottom"};
    expect_nothing_moves(scene);
}

/// A ground whose height is typed with fewer digits than the rock's upper side: the horizontal part does not end below that side.
TEST(InsituStress, EndsAtTheGroundUpToAMillimetre)
{
    for (const double below : {0.0, 1e-5, 9e-4})
    {
        CaseDef scene = rock({25.0, -55.0, 90.0}, {.surface = 14.0 - below, .ratio = 1.5, .ratio_offset = 1e6});
        scene.gravity = {0.0, -9.81};
        scene.domain.fixed = {"left", "right", "bottom"};
        const CaseRun run(scene);
        EXPECT_LT(summarise_insitu(run.model(), run.state()).unbalance, 1e-12 + 10.0 * below) << below;
    }
}

/// Between joints of almost the same dip lie slivers: a side beside the tip of one bends by their angle, and the flat one of its two pieces bears, not the longer one.
TEST(InsituStress, IsBorneBesideTheTipsOfSlivers)
{
    for (const std::vector<double>& dips : {std::vector<double>{-74.5, -73.9, -134.5}, {20.0, 20.6, -40.0}})
    {
        const CaseRun run(rock(dips, {.stress = StressDef{-8e6, -5e6, 1e6}}));
        EXPECT_LT(summarise_insitu(run.model(), run.state()).unbalance, 1e-12) << "dip " << dips.front();
    }
}

/// On 3 m from 1 to 2 MPa: 2.0 and 2.5 MN, the resultant and the moment of the traction.
TEST(InsituStress, OfALinearTractionHasItsMoment)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "wall", scenes::rectangle({-1.0, 0.0}, {0.0, 3.0}));
    scenes::add_block(scene, "block", scenes::rectangle({0.0, 0.0}, {1.0, 3.0}));
    scene.insitu = {.given = true, .stress = StressDef{-2e6, 0.0, 0.0}, .gradient = {1e6 / 3.0, 0.0, 0.0}};
    const CaseRun run(scene);
    const Contacts& contacts = run.state().contacts;
    ASSERT_EQ(contacts.size(), 1);
    const double first = contacts.normal_force(0, 0), second = contacts.normal_force(1, 0);
    EXPECT_NEAR(std::max(first, second), 2.5e6, 1e-3);
    EXPECT_NEAR(std::min(first, second), 2.0e6, 1e-3);
}

/// The weight of a block without a domain is that of its own material.
TEST(InsituStress, UnderTheGroundIsThatOfBlocksWithoutADomain)
{
    CaseDef scene = scenes::block_on_ground();
    scene.materials[0].name = "granite";
    for (BlockDef& block : scene.blocks)
        block.material = "granite";
    scene.insitu = {.given = true, .surface = 1.0, .ratio = 0.5};
    const CaseRun run(scene);
    EXPECT_LT(summarise_insitu(run.model(), run.state()).unbalance, 1e-12);
}

/// tau / sigma_n under (-15, -5) MPa: 0.4409 at 15, 0.5774 at 30, 0.5 at 45, 0.3464 at 60 degrees; at 28 degrees of friction only 30 slips.
TEST(InsituStress, TellsWhichJointsAreAboveTheirStrength)
{
    for (const auto& [dip, used] : {std::pair(15.0, 0.4409270), {30.0, 0.5773503}, {45.0, 0.5}, {60.0, 0.3464102}})
    {
        CaseDef scene = rock({dip, dip - 90.0}, {.stress = StressDef{-15e6, -5e6, 0.0}});
        scene.joint_sets[0].name = "asked";
        scene.joints[0].friction_angle_deg = 28.0;
        const CaseRun run(scene);
        const InsituSummary summary = summarise_insitu(run.model(), run.state());
        ASSERT_EQ(summary.sets.size(), 2U);
        const StressedSet& set = summary.sets[summary.sets[0].name == "asked" ? 0 : 1];
        EXPECT_NEAR(set.most_used, used / std::tan(radians(28.0)), 2e-6);
        EXPECT_EQ(set.above, dip == 30.0 ? set.joints : 0) << "dip " << dip;
        EXPECT_DOUBLE_EQ(set.length_above, dip == 30.0 ? set.length : 0.0);
    }
}

/// Of a joint without friction or without normal stress, round-off is above its strength of 0.
TEST(InsituStress, RoundOffIsNotAboveAnyStrength)
{
    for (const StressDef& stress : {StressDef{-5e6, -5e6, 0.0}, StressDef{-15e6, 0.0, 0.0}})
        for (const double dip : {0.0, 15.0, 37.0})
        {
            if (stress.yy == 0.0 && dip != 0.0)
                continue;
            CaseDef scene = rock({dip, dip - 90.0}, {.stress = stress});
            scene.joints[0].friction_angle_deg = stress.yy == 0.0 ? 30.0 : 0.0;
            const CaseRun run(scene);
            for (const StressedSet& set : summarise_insitu(run.model(), run.state()).sets)
                EXPECT_EQ(set.above, 0) << "dip " << dip;
        }
}

/// Blocks of 1 m around a hole of 57 of them under 1 MPa on all sides, K_N = K_S, no slip. The exact linear answer for rigid blocks: hoop stresses of 1.64329,
/// 1.52771 and 1.38110 MPa in the first joints at the crown, which comes down by 0.369245 mm.
TEST(InsituStress, IsThatOfTheLinearAnswerAroundAHole)
{
    CaseDef scene = rock({0.0, 90.0}, {.stress = StressDef{-1e6, -1e6, 0.0}});
    scene.domain = {
        .given = true, .width = 41.0, .height = 41.0, .origin = {-20.5, -20.5}, .fixed = {"left", "right", "bottom", "top"}};
    for (JointSetDef& set : scene.joint_sets)
    {
        set.spacing = 1.0;
        set.origin = Vec2(0.5, 0.5);
    }
    scene.joints[0] = {
        .name = "default", .normal_stiffness = 1e10, .shear_stiffness = 1e10, .friction_angle_deg = 85.0, .cohesion = 1e9};
    const auto middle_of = [](const CaseRun& run, Index b)
    { return Vec2(run.state().blocks.reference_position[b] + run.model().origin); };
    StageDef dig{.name = "dig", .until_converged = true, .max_cycles = 40000};
    for (const CaseRun drawn(scene); const Index b : drawn.model().slot_of_user)
        if (middle_of(drawn, b).norm() < 4.2)
            dig.excavate.push_back(drawn.model().name[b]);
    EXPECT_EQ(dig.excavate.size(), 57U);
    scene.stages = {dig};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(8000);
    const auto hoop = [&](double y)
    {
        for (Index i = 0; i < run.state().contacts.size(); ++i)
            if (is_closed_contact(run.state(), i))
            {
                const ContactReport joint = report_contact(run.state(), i);
                const Vec2 middle = 0.5 * (joint.point[0] + joint.point[1]) + run.model().origin;
                if ((middle - Vec2(0.5, y)).norm() < 0.05)
                    return joint.normal_force / joint.length;
            }
        return 0.0;
    };
    EXPECT_NEAR(hoop(5.0), 1.64329e6, 0.01 * 1.64329e6);
    EXPECT_NEAR(hoop(6.0), 1.52771e6, 0.01 * 1.52771e6);
    EXPECT_NEAR(hoop(7.0), 1.38110e6, 0.01 * 1.38110e6);
    for (Index b = 0; b < run.model().blocks(); ++b)
    {
        const Vec2 from_crown = middle_of(run, b) - Vec2(0.0, 5.0);
        if (run.state().blocks.present[b] != 0 && from_crown.norm() < 0.01)
        {
            EXPECT_NEAR(run.state().blocks.displacement(b).y(), -0.369245e-3, 0.01 * 0.369245e-3);
        }
    }
}
}  // namespace
}  // namespace hdem
