#include "core/contact/closing.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace hdem::test
{
namespace
{
/// A number between two bounds.
rc::Gen<double> between(double low, double high)
{
    return rc::gen::map(rc::gen::inRange(0, 1'000'000), [=](int i) { return low + (high - low) * i / 1e6; });
}

double overlap_before(const OverlapCourse& course)
{
    return course.now - course.past;
}

double next_overlap(const OverlapCourse& course)
{
    return course.now + course.coast + course.others - closing_share(course) * course.answer;
}

/// What a cycle adds to the energy of blocks and spring, over K_N L: the spring's energy less its work, when the overlap goes on as `course` says.
double gain(const OverlapCourse& course)
{
    const double share = closing_share(course), before = overlap_before(course), next = next_overlap(course);
    return 0.5 * course.now * (std::max(next, 0.0) - std::max(before, 0.0) - share * (next - before));
}

OverlapCourse any_course(double least_others, double most_others)
{
    return {.now = *between(0.0, 1.0),
            .past = *between(-2.0, 2.0),
            .coast = *between(-2.0, 2.0),
            .others = *between(least_others, most_others),
            .answer = *between(0.0, 2.0)};
}

RC_GTEST_PROP(ClosingShare, WorksJustAsMuchAsTheEnergyOfTheSpringChanges, ())
{
    const OverlapCourse course = any_course(0.0, 0.0);
    const double share = closing_share(course);
    RC_ASSERT(share >= 0.0 && share <= 1.0);
    RC_ASSERT(std::abs(gain(course)) <= 1e-14);  // overlaps up to 3
}

RC_GTEST_PROP(ClosingShare, LosesEnergyWhereOthersPullTheBlocksApart, ())
{
    const OverlapCourse course = any_course(-2.0, 0.0);
    const double before = overlap_before(course), next = next_overlap(course);
    RC_PRE((before < 0.0 ? next >= before
                         : next <= before));  // closes, or opens: neither torn out as it closes nor pressed on as it opens
    RC_ASSERT(gain(course) <= 1e-14);
}

RC_GTEST_PROP(ClosingShare, IsOneForWhatStaysClosed, ())
{
    const double now = *between(0.01, 1.0);
    const double answer = *between(0.0, 4.0) * now;  // up to the stable limit
    RC_ASSERT(closing_share<double>({.now = now, .past = 0.0, .coast = 0.0, .others = answer, .answer = answer}) == 1.0);
}

/// A point that bears little beside one that bears much: that one presses it by turning the blocks, and other forces pull it as much.
TEST(ClosingShare, IsOneForWhatRestsAsTheOtherPointPressesIt)
{
    EXPECT_EQ(closing_share(OverlapCourse{.now = 1.9e-4, .others = -1.6e-4, .answer = -1.6e-4}), 1.0);
    EXPECT_LT(closing_share(OverlapCourse{.now = 1.9e-4, .others = -1.6e-4}), 1.0);
}

TEST(ClosingShare, ComesFromTheTwoSidesOfTheFirstOverlap)
{
    // From a gap of 1 to an overlap of 1, slowly answered: half of the way to the next overlap, 3, would be closed: 3 / (3 + 1).
    EXPECT_DOUBLE_EQ(closing_share<double>({.now = 1.0, .past = 2.0, .coast = 2.0, .others = 0.0, .answer = 0.0}), 0.75);
    EXPECT_DOUBLE_EQ(closing_share<double>({.now = 1.0, .past = -2.0, .coast = -2.0, .others = 0.0, .answer = 0.0}), 0.75)
        << "and back";
    EXPECT_EQ(closing_share<double>({.now = 1.0, .past = 0.9, .coast = 0.9, .others = 0.0, .answer = 0.1}), 1.0);
}

/// Speed at which a slab leaves the ground that it hit flat with 1 m/s.
double speed_after_bounce(DampingPreset damping, double step_of_limit, double height)
{
    CaseDef scene = scenes::block_on_ground(10.0, 0.1);
    const double omega = std::sqrt(7e9 * 10.0 / (2700.0 * 10.0 * 0.1));
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.damping.preset = damping;
    scene.damping.local = 0.0;
    scene.time.step = step_of_limit * 2.0 / omega;
    scene.blocks[1].velocity = {0.0, -1.0};
    scene.blocks[1].fix_rotation = true;  // the springs at its ends are stiffer against turning
    CaseRun run(scene, [&](const Model& model, State& state) { state.blocks.motion[model.find_block("block")].y += height; });
    run.advance(40);
    EXPECT_GT(run.position("block").y(), 0.05) << "has left the ground";
    return run.velocity("block").y();
}

TEST(Bounce, OnSpringsKeepsTheSpeedAtAnyStep)
{
    double worst_late = 0.0;
    for (const double share : {0.1, 0.3, 0.6, 0.9})
        for (const double height : {1e-5, 3e-5, 7e-5, 1.1e-4, 2.3e-4})
        {
            EXPECT_NEAR(speed_after_bounce(DampingPreset::dynamic, share, height), 1.0, 1e-9)
                << share << " of the limit from " << height;
            worst_late = std::max(worst_late, std::abs(speed_after_bounce(DampingPreset::paper, share, height) - 1.0));
        }
    EXPECT_GT(worst_late, 0.1) << "the paper's springs take hold and let go late";
}
}  // namespace
}  // namespace hdem::test
