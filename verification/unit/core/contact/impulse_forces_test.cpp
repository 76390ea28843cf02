#include "core/contact/impulse_forces.h"
#include "core/contact/impulse_law.h"
#include "verification/unit/block_pair.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
constexpr double deflection = 1e-5;  // m
constexpr double half_stiffness = 7e9 * 0.5;

/// A unit block on another, pressed into its springs; then it moves as far again, and impulses take over.
class HandedOver : public testing::Test
{
  protected:
    HandedOver() : pair(test::pair_scene(scenes::rectangle({-0.5, -0.5}, {0.5, 0.5}), scenes::rectangle({-0.5, -0.5}, {0.5, 0.5})))
    {
        pair.place(pair.a, {0.0, 0.0}, 0.0);
        pair.place(pair.b, {0.0, 1.0 - deflection}, 0.0);
        pair.search();
        pair.evaluate(ContactLaw::springs);
        pair.place(pair.b, {0.0, 1.0 - 2.0 * deflection}, 0.0);
        pair.evaluate(ContactLaw::impulses);
        collect_impulse_points({0, 1}, pair.model, pair.state.blocks, pair.state.contacts, points);
    }

    /// Force with which the spring of the first point would begin now.
    [[nodiscard]] double spring_force() const
    {
        return half_stiffness * (2.0 * deflection - pair.state.contacts.rest_overlap(points[0].end, 0));
    }

    test::BlockPair pair;
    std::vector<ImpulsePoint> points;
};

TEST_F(HandedOver, PointsKeepWhatTheirSpringsHeld)
{
    ASSERT_EQ(points.size(), 2U);
    for (const ImpulsePoint& p : points)
        EXPECT_NEAR(p.spring_force, half_stiffness * deflection, 1e-6 * half_stiffness * deflection);
}

TEST_F(HandedOver, SpringsBeginWithTheForceOfTheLastImpulse)
{
    aim_impulses(pair.state.blocks, points);
    points[0].impulse_normal = 0.3 * half_stiffness * deflection * pair.model.time_step;
    store_impulses(pair.model, pair.state.blocks, points, pair.state.contacts);
    EXPECT_NEAR(spring_force(), 0.3 * half_stiffness * deflection, 1e-6 * half_stiffness * deflection);
}

/// An impulse of 1000 times the load, at a point where nothing approaches: others have hit one of its blocks.
TEST_F(HandedOver, SpringsDoNotBeginWithTheImpactsOfOthers)
{
    aim_impulses(pair.state.blocks, points);
    ImpulsePoint& p = points[0];
    p.spring_force = 500.0;
    p.impulse_normal = 1000.0 * half_stiffness * deflection * pair.model.time_step;
    store_impulses(pair.model, pair.state.blocks, points, pair.state.contacts);
    const double most = 500.0 + p.mass_normal * pair.model.gravity.norm();
    const double rest = pair.state.contacts.rest_overlap(p.end, 0);
    EXPECT_NEAR(p.stiffness * (p.overlap - rest), most, 1e-6 * most);
}
}  // namespace
}  // namespace hdem
