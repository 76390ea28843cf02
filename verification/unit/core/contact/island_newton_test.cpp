#include "core/contact/island_newton.h"
#include "verification/unit/core/contact/island_problems.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hdem
{
namespace
{
constexpr double stay = 1e-9;

/// By hand: each contact carries all that lies above it. One step, as no point opens.
TEST(IslandNewton, CarriesAColumnInOneStep)
{
    for (const double ratio : {1.0, 10.0, 1e3, 1e6})
        for (const int lights : {1, 5, 20})
        {
            std::vector<double> masses(static_cast<std::size_t>(lights), 2700.0 / ratio);
            masses.push_back(2700.0);
            const IslandProblem found = newton_step(column(masses), 1e-3 * stay / ratio);
            EXPECT_LE(found.error(), 1e-6 * fall) << ratio << ", " << lights;
            double above = 0.0;
            for (std::size_t i = masses.size(); i-- > 0;)
            {
                above += masses[i];
                EXPECT_NEAR(found.points[i].impulse_normal, above * fall, 1e-5 * above * fall) << ratio << ", " << lights;
            }
        }
}

TEST(IslandNewton, TurnsAHeavyBlockRoundThroughLightOnes)
{
    IslandProblem start = column({2.7e-3, 2.7e-3, 2700.0});
    start.blocks[3].velocity.y = -2.0;
    start.points[2].target = -0.5 * 2.0;
    const IslandProblem found = solve_by_newton(start, 1e-9);
    EXPECT_LE(found.error(), 1e-9);
    EXPECT_NEAR(found.blocks[3].velocity.y, 1.0, 1e-8);
    EXPECT_NEAR(found.points[0].impulse_normal, 2700.0 * 3.0, 1e-4);
}

/// A column pushed sideways at once, by more or by less than friction bears.
TEST(IslandNewton, KeepsToCoulombsLaw)
{
    const double friction = std::tan(radians(30.0));
    for (const double ratio : {1.0, 1e3, 1e6})
        for (const double sign : {-1.0, 1.0})
        {
            IslandProblem start = column({2700.0 / ratio, 2700.0}, friction);
            start.blocks[2].velocity.x = sign * 0.9 * friction * fall;
            EXPECT_NEAR(solve_by_newton(start, 1e-6 * fall).blocks[2].velocity.x, 0.0, 1e-5 * fall) << ratio;
            start.blocks[2].velocity.x = sign * 3.0 * friction * fall;
            const IslandProblem slides = solve_by_newton(start, 1e-6 * fall);
            EXPECT_LE(slides.error(), 1e-6 * fall);
            EXPECT_NEAR(slides.blocks[2].velocity.x, sign * 2.0 * friction * fall, 1e-5 * fall) << ratio;
        }
}

/// What slips bears all of its cohesion, also where no impulse presses it.
TEST(IslandNewton, SlipsAtItsCohesion)
{
    IslandProblem start = column({2700.0}, 0.5);
    const double cohesive = 0.1 * 2700.0 * fall;
    start.points[0].cohesive_impulse = cohesive;
    start.blocks[1].velocity = {2.0 * fall, 3.0 * fall, 0.0};  // up and away, the joint bears no tension
    const IslandProblem found = newton_step(start, stay);
    EXPECT_EQ(found.points[0].impulse_normal, 0.0);
    EXPECT_DOUBLE_EQ(std::abs(found.points[0].impulse_shear), cohesive);
    EXPECT_NEAR(found.blocks[1].velocity.x, 1.9 * fall, 1e-12 * fall);
}

TEST(IslandNewton, LeavesPointsThatPartWithoutAnyImpulse)
{
    IslandProblem start = column({2700.0, 2.7e-3}, 0.5);
    start.blocks[2].velocity.y = 1.0;
    start.points[1].impulse_normal = 1e-7;
    const IslandProblem found = solve_by_newton(start, 1e-6 * fall);
    EXPECT_EQ(found.points[1].impulse_normal, 0.0);
    EXPECT_EQ(found.points[1].impulse_shear, 0.0);
    EXPECT_NEAR(found.points[0].impulse_normal, 2700.0 * fall, 1e-5 * 2700.0 * fall);
}

/// Three points under a block that cannot turn bear it in any shares. Those of now stay, and what they lack is shared out evenly.
TEST(IslandNewton, ChangesImpulsesNoMoreThanItMust)
{
    IslandProblem start = column({300.0});
    start.points.resize(3, start.points[0]);
    const double weight = 300.0 * fall;
    start.set_impulses({0.6 * weight, 0.2 * weight, 0.1 * weight}, {0.0, 0.0, 0.0});
    const IslandProblem found = solve_by_newton(start, 1e-9 * fall);
    EXPECT_LE(found.error(), 1e-9 * fall);
    EXPECT_NEAR(found.points[0].impulse_normal, (0.6 + 0.1 / 3.0) * weight, 1e-6 * weight);
    EXPECT_NEAR(found.points[1].impulse_normal, (0.2 + 0.1 / 3.0) * weight, 1e-6 * weight);
    EXPECT_NEAR(found.points[2].impulse_normal, (0.1 + 0.1 / 3.0) * weight, 1e-6 * weight);
}

/// Of islands at random, far from their solution, most are solved without interior points. None is made worse.
TEST(IslandNewton, SolvesMostIslandsOfAnyShape)
{
    int solved = 0;
    for (std::uint32_t seed = 1; seed <= 300; ++seed)
    {
        const IslandProblem start = random_island(seed);
        const IslandProblem found = solve_by_newton(start, 1e-6);
        solved += found.error() <= 1e-6 ? 1 : 0;
        EXPECT_LE(found.error(), start.error()) << seed;
    }
    EXPECT_GE(solved, 200);
}
}  // namespace
}  // namespace hdem
