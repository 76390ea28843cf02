#include "verification/checks/radial_profile.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"

namespace hdem::verification
{
namespace
{
/// Three unit blocks at rest on each other; the profile goes down from the centre of the uppermost one.
class ProfileOfAStack : public testing::Test
{
  protected:
    static constexpr double weight = 2700.0 * 9.81;
    hdem::test::CaseRun run{[]
                            {
                                CaseDef scene = scenes::stack(3);
                                scene.contact.method = Method::force;
                                scene.damping.preset = DampingPreset::paper;
                                return scene;
                            }()};
    Ray ray{.from = {0.0, 2.5}, .angle_deg = 270.0, .begins_at = 0.1, .reaches_to = 3.0};

    void SetUp() override
    {
        run.advance(20000);
        ray.from -= run.model().origin;
    }
};

TEST_F(ProfileOfAStack, HasTheWeightAboveEachContact)
{
    for (const double angle : {270.0, 268.0})
    {
        ray.angle_deg = angle;
        const std::vector<StressPoint> points = stress_along(ray, run.model(), run.state());
        ASSERT_EQ(points.size(), 3u);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const double expected = weight * static_cast<double>(i + 1);
            EXPECT_NEAR(points[i].distance, (0.5 + static_cast<double>(i)) / std::sin(radians(360.0 - angle)), 1e-4) << "overlaps";
            EXPECT_NEAR(points[i].normal, expected, 1e-6 * expected) << "residual motion";
            EXPECT_NEAR(points[i].traction, expected, 1e-6 * expected);
        }
    }
}

TEST_F(ProfileOfAStack, KeepsToItsRange)
{
    ray.begins_at = 1.0;
    ray.reaches_to = 2.0;
    EXPECT_EQ(stress_along(ray, run.model(), run.state()).size(), 1u);
    ray.angle_deg = 90.0;
    ray.begins_at = 0.0;
    EXPECT_TRUE(stress_along(ray, run.model(), run.state()).empty()) << "nothing lies above";
}

TEST_F(ProfileOfAStack, LeavesDetachedBlocksOut)
{
    State state = run.state();
    state.blocks.reference_position[run.slot("block3")].x() -= 2.0 * run.model().convergence.detached_distance;
    EXPECT_EQ(stress_along(ray, run.model(), state).size(), 2u);
}

TEST(DistanceToOutline, IsWhereTheRayLeavesForGood)
{
    const Polygon square{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
    EXPECT_NEAR(distance_to_outline({0.0, 0.0}, 10.0, square), 1.0 / std::cos(radians(10.0)), 1e-12);
    EXPECT_NEAR(distance_to_outline({0.0, 0.5}, 270.0, square), 1.5, 1e-12);
}
}  // namespace
}  // namespace hdem::verification
