#include "core/contact/interior_point.h"
#include "verification/unit/core/contact/island_problems.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hdem
{
namespace
{
double impulse_sum(const IslandProblem& problem, std::size_t point)
{
    return problem.points[point].impulse_normal;
}

/// By hand: each contact carries all that lies above it.
TEST(InteriorPoint, CarriesAColumnWhateverItsMasses)
{
    for (const double ratio : {1.0, 10.0, 1e3, 1e6, 1e9})
        for (const int lights : {1, 5, 20})
        {
            std::vector<double> masses(static_cast<std::size_t>(lights), 2700.0 / ratio);
            masses.push_back(2700.0);
            const IslandProblem start = column(masses);
            EXPECT_NEAR(start.error(), fall, 1e-12 * fall);
            const IslandProblem found = InteriorPoint(start).solve(1e-6 * fall);
            EXPECT_LE(found.error(), 1e-6 * fall) << ratio << ", " << lights;
            double above = 0.0;
            for (std::size_t i = masses.size(); i-- > 0;)
            {
                above += masses[i];
                EXPECT_NEAR(impulse_sum(found, i), above * fall, 1e-5 * above * fall) << ratio << ", " << lights;
            }
        }
}

/// Two light blocks between the ground and a heavy one that comes down; with a restitution it must leave upwards, and the light ones must stay.
TEST(InteriorPoint, TurnsAHeavyBlockRoundThroughLightOnes)
{
    IslandProblem start = column({2.7e-3, 2.7e-3, 2700.0});
    start.blocks[3].velocity.y = -2.0;
    start.points[2].target = -0.5 * 2.0;
    const IslandProblem found = InteriorPoint(start).solve(1e-9);
    EXPECT_LE(found.error(), 1e-9);
    EXPECT_NEAR(found.blocks[3].velocity.y, 1.0, 1e-8);
    EXPECT_NEAR(found.blocks[1].velocity.y, 0.0, 1e-8);
    EXPECT_NEAR(found.blocks[2].velocity.y, 0.0, 1e-8);
    EXPECT_NEAR(impulse_sum(found, 0), 2700.0 * 3.0, 1e-4);
}

/// What slides is slowed by friction, what friction can hold is held: a column pushed sideways at once, by more or by less than it bears.
TEST(InteriorPoint, KeepsToCoulombsLaw)
{
    const double friction = std::tan(radians(30.0));
    for (const double ratio : {1.0, 1e3, 1e6})
    {
        IslandProblem start = column({2700.0 / ratio, 2700.0}, friction);
        start.blocks[2].velocity.x = 0.9 * friction * fall;
        const IslandProblem held = InteriorPoint(start).solve(1e-6 * fall);
        EXPECT_NEAR(held.blocks[2].velocity.x, 0.0, 1e-5 * fall) << ratio;
        start.blocks[2].velocity.x = 3.0 * friction * fall;
        const IslandProblem slides = InteriorPoint(start).solve(1e-6 * fall);
        EXPECT_LE(slides.error(), 1e-6 * fall);
        EXPECT_NEAR(slides.blocks[2].velocity.x, 2.0 * friction * fall, 1e-5 * fall) << ratio;
    }
}

TEST(InteriorPoint, LeavesPointsThatPartWithoutAnyImpulse)
{
    IslandProblem start = column({2700.0, 2.7e-3}, 0.5);
    start.blocks[2].velocity.y = 1.0;
    const IslandProblem found = InteriorPoint(start).solve(1e-6 * fall);
    EXPECT_EQ(found.points[1].impulse_normal, 0.0);
    EXPECT_EQ(found.points[1].impulse_shear, 0.0);
    EXPECT_NEAR(found.points[0].impulse_normal, 2700.0 * fall, 1e-5 * 2700.0 * fall);
}

}  // namespace
}  // namespace hdem
