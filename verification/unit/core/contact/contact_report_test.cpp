#include "core/contact/contact_report.h"
#include "verification/unit/small_run.h"

namespace hdem
{
namespace
{
using test::SmallRun;

constexpr Index ground = 0;
constexpr Index block = 2;

TEST(ContactReport, NormalPointsFromTheReferenceBlockToTheOther)
{
    SmallRun run = test::small_run();
    run.state.blocks.motion[block].y -= 1e-5;
    test::load_contact(run, 0, 26487.0, 100.0, Regime::stick);
    const ContactReport report = report_contact(run.state, 0);
    EXPECT_EQ(report.first, ground);
    EXPECT_EQ(report.second, block);
    EXPECT_NEAR((report.normal - Vec2(0.0, 1.0)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((report.shear_axis() - Vec2(-1.0, 0.0)).norm(), 0.0, 1e-15);
    EXPECT_NEAR(report.length, 1.0, 1e-12);
    EXPECT_NEAR(report.overlap, 1e-5, 1e-15);
    EXPECT_EQ(report.closed_points, 2);
    // Half-way between the faces, from the block's right to its left, in local coordinates.
    EXPECT_NEAR((report.point[0] - Vec2(1.0, -0.5e-5)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((report.point[1] - Vec2(0.0, -0.5e-5)).norm(), 0.0, 1e-12);
}

/// The same touch seen from the other block: normal and shear axis turn round, so that the forces are the same numbers.
TEST(ContactReport, ForcesDoNotDependOnWhichBlockOwnsTheReferenceEdge)
{
    SmallRun run = test::small_run();
    test::add_contact(run, block, 0, ground, 2);
    test::load_contact(run, 0, 26487.0, 100.0, Regime::slip);
    test::load_contact(run, 1, 26487.0, 100.0, Regime::slip);
    const ContactReport one = report_contact(run.state, 0);
    const ContactReport other = report_contact(run.state, 1);
    const Vec2 on_second = one.normal_force * one.normal + one.shear_force * one.shear_axis();
    const Vec2 on_first = other.normal_force * other.normal + other.shear_force * other.shear_axis();
    EXPECT_NEAR((on_second + on_first).norm(), 0.0, 1e-9) << "action is reaction";
}

/// What the slope of an edge adds acts along the shear axis, in the report and in the mean stress.
TEST(ContactReport, TiltForcesCountAsForcesOnTheBlock)
{
    SmallRun run = test::small_run();
    test::load_contact(run, 0, 26487.0, 100.0, Regime::stick);
    const MeanStress before = mean_stresses(run.model, run.state)[block];
    const ContactReport report = report_contact(run.state, 0);
    for (int k = 0; k < 2; ++k)
        run.state.contacts.lane[0].tilt_force[k][0] = 400.0;
    EXPECT_EQ(report_contact(run.state, 0).tilt_force, 800.0);
    EXPECT_EQ(report_contact(run.state, 0).shear_force, report.shear_force);
    const MeanStress after = mean_stresses(run.model, run.state)[block];
    const Vec2 force = 800.0 * report.shear_axis(), arm = 0.5 * (report.point[0] + report.point[1]) - Vec2(0.5, 0.5);
    EXPECT_NEAR(after.xy - before.xy, -0.5 * (arm.x() * force.y() + arm.y() * force.x()) / run.model.area[block], 1e-9);
    EXPECT_GT(std::abs(after.xy - before.xy), 100.0);
}

TEST(ContactReport, OpenAndExcavatedContactsAreNotClosed)
{
    SmallRun run = test::small_run();
    EXPECT_FALSE(is_closed_contact(run.state, 0));
    test::load_contact(run, 0, 1.0, 0.0, Regime::impulse);
    EXPECT_TRUE(is_closed_contact(run.state, 0));
    EXPECT_EQ(report_contact(run.state, 0).impulse_points, 2);
    run.state.blocks.present[block] = 0;
    EXPECT_FALSE(is_closed_contact(run.state, 0));
}

/// A block 1 m x 1 m pressed between two plates, tau on all four faces: the stress is that of a uniform body, exactly.
TEST(MeanStress, IsTheStressOfAUniformlyLoadedBlock)
{
    SmallRun run;
    run.model.origin = {0.0, 0.0};
    test::add_block(run, "low", {test::rectangle(0, -1, 1, 0)}, true);
    test::add_block(run, "high", {test::rectangle(0, 1, 1, 2)}, true);
    test::add_block(run, "left", {test::rectangle(-1, 0, 0, 1)}, true);
    test::add_block(run, "right", {test::rectangle(1, 0, 2, 1)}, true);
    const Index middle = test::add_block(run, "middle", {test::rectangle(0, 0, 1, 1)}, false);
    test::add_contact(run, 0, 2, middle, 0);
    test::add_contact(run, 1, 0, middle, 2);
    test::add_contact(run, 2, 1, middle, 3);
    test::add_contact(run, 3, 3, middle, 1);
    // Equal shear of opposite sense on neighbouring faces keeps the moment zero.
    for (const auto& [contact, normal, shear] :
         {std::tuple(0, 3e5, 1e5), std::tuple(1, 3e5, 1e5), std::tuple(2, 2e5, -1e5), std::tuple(3, 2e5, -1e5)})
        test::load_contact(run, contact, normal, shear, Regime::stick);
    const MeanStress stress = mean_stresses(run.model, run.state)[middle];
    EXPECT_NEAR(stress.xx, 2e5, 1e-6);
    EXPECT_NEAR(stress.yy, 3e5, 1e-6);
    EXPECT_NEAR(std::abs(stress.xy), 1e5, 1e-6);
    // On the lower face (outward normal -y) the traction is along -x: tension-positive sigma_xy = +1e5, here with the other sign.
    EXPECT_LT(stress.xy, 0.0);
    EXPECT_NEAR(stress.magnitude(), std::sqrt(4e10 + 9e10 + 2e10), 1e-3);
}
}  // namespace
}  // namespace hdem
