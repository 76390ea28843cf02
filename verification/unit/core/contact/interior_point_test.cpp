#include "core/contact/interior_point.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hdem
{
namespace
{
constexpr double fall = 9.81e-5;  // velocity that weight gives in a cycle [m/s]

/// Blocks that cannot turn, as masses on a vertical line; the first one is the ground.
IslandProblem column(const std::vector<double>& masses, double friction = 0.0)
{
    IslandProblem problem;
    problem.blocks.push_back({});
    for (const double mass : masses)
        problem.blocks.push_back({{.inverse_mass_x = 1.0 / mass, .inverse_mass_y = 1.0 / mass}, {0.0, -fall, 0.0}});
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
        ImpulsePoint p;
        p.ref = static_cast<Index>(i);
        p.inc = static_cast<Index>(i + 1);
        p.t_x = -1.0;  // m points down, into the lower block
        p.friction = friction;
        const double inverse = 1.0 / masses[i] + (i > 0 ? 1.0 / masses[i - 1] : 0.0);
        p.mass_normal = p.mass_shear = 1.0 / inverse;
        problem.points.push_back(p);
    }
    return problem;
}

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
/// No number is no solution: neither what is asked nor what is found may pass for right.
TEST(InteriorPoint, AVelocityThatIsNoNumberIsAnError)
{
    for (double Triple::*const axis : {&Triple::x, &Triple::y})
    {
        IslandProblem problem = column({1.0, 2.0, 3.0}, 0.5);
        problem.blocks[1].velocity.*axis = std::numeric_limits<double>::quiet_NaN();
        EXPECT_TRUE(std::isnan(problem.error()));
        EXPECT_TRUE(std::isnan(solve_all_at_once(problem, 1e-9).error()));
    }
}

/// A wedge of 64 degrees between two faces of one block, with friction 40 degrees: it holds itself, by any impulses, and one of its points has to part at 0.1 m/s. As met
/// from a heap of blocks with hollow corners.
TEST(InteriorPoint, DoesNotLetTheImpulsesOfAWedgeGrow)
{
    IslandProblem problem;
    problem.blocks.push_back({{1.7287105426359753e-4, 1.7287105426359753e-4, 4.698615092930175e-4},
                              {-0.52008421815302341, -1.1178533145340965, -0.78566835082409459}});
    problem.blocks.push_back({{7.4319340550092414e-4, 7.4319340550092414e-4, 2.9447848675488411e-3},
                              {-1.438499615614246, -0.81958158489225696, -0.48796918173505544}});
    problem.points.push_back({.ref = 0,
                              .inc = 1,
                              .t_x = 0.6423197853657755,
                              .t_y = 0.76643675102885311,
                              .ref_t = -0.48787192869126006,
                              .ref_m = -0.61478284459807819,
                              .inc_t = 0.70934882453600689,
                              .inc_m = 0.028143467726461702,
                              .mass_normal = 398.463,
                              .mass_shear = 912.421,
                              .friction = 0.8391,
                              .impulse_normal = 1851.0876102916054,
                              .impulse_shear = -1553.2469310725187});
    problem.points.push_back({.ref = 1,
                              .inc = 0,
                              .t_x = 0.16096665822830591,
                              .t_y = 0.98695984464354547,
                              .ref_t = 0.62429407432828854,
                              .ref_m = 0.33798863958525532,
                              .inc_t = -0.73337833609992842,
                              .inc_m = 0.39644718044397342,
                              .mass_normal = 431.688,
                              .mass_shear = 753.969,
                              .target = -0.099212748358694466,
                              .friction = 0.8391,
                              .impulse_normal = 2088.9862366714092,
                              .impulse_shear = -1497.8087805286314});
    const IslandProblem found = solve_all_at_once(problem, 1e-6);
    EXPECT_LT(found.greatest_impulse(), 1e7);
    EXPECT_LE(found.error(), problem.error());
}

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

/// Points anywhere on blocks that turn, with any masses from 1 to 1e6, friction, speeds and directions.
IslandProblem random_island(std::uint32_t seed)
{
    std::mt19937 bits(seed);
    const auto between = [&](double low, double high) { return low + (high - low) * static_cast<double>(bits()) / 4294967296.0; };
    IslandProblem problem;
    problem.blocks.push_back({});
    const int blocks = 2 + static_cast<int>(between(0.0, 8.0));
    for (int i = 0; i < blocks; ++i)
    {
        const double mass = std::pow(10.0, between(-3.0, 3.0));
        problem.blocks.push_back(
            {{1.0 / mass, 1.0 / mass, 6.0 / mass, 0.0}, {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)}});
    }
    for (int i = 1; i <= 3 * blocks; ++i)
    {
        ImpulsePoint p;
        p.inc = 1 + (i - 1) % blocks;
        p.ref = std::min(p.inc - 1, static_cast<Index>(between(0.0, p.inc)));
        const double angle = between(0.0, 6.28);
        p.t_x = std::cos(angle);
        p.t_y = std::sin(angle);
        p.ref_t = between(-0.5, 0.5);
        p.ref_m = between(-0.5, 0.0);
        p.inc_t = between(-0.5, 0.5);
        p.inc_m = between(0.0, 0.5);
        p.friction = between(0.0, 0.6);
        const BlockInertia& ref = problem.blocks[p.ref].inertia;
        const BlockInertia& inc = problem.blocks[p.inc].inertia;
        const double along = ref.inverse_mass_x + inc.inverse_mass_x;
        p.mass_normal = 1.0 / (along + ref.inverse_inertia * p.ref_t * p.ref_t + inc.inverse_inertia * p.inc_t * p.inc_t);
        p.mass_shear = 1.0 / (along + ref.inverse_inertia * p.ref_m * p.ref_m + inc.inverse_inertia * p.inc_m * p.inc_m);
        problem.points.push_back(p);
    }
    return problem;
}

/// All laws hold at all points, and kinetic energy falls. Where friction alone decides one in some hundred islands has no end: the best
/// impulses met are no worse than those at the start.
TEST(InteriorPoint, SolvesIslandsOfAnyShape)
{
    int solved = 0;
    constexpr int islands = 300;
    for (std::uint32_t seed = 1; seed <= islands; ++seed)
    {
        const IslandProblem start = random_island(seed);
        const IslandProblem found = solve_all_at_once(start, 1e-6);
        const auto kinetic = [](const IslandProblem& problem)
        {
            double sum = 0.0;
            for (std::size_t i = 1; i < problem.blocks.size(); ++i)
            {
                const auto& [inertia, v] = problem.blocks[i];
                sum += 0.5 * ((v.x * v.x + v.y * v.y) / inertia.inverse_mass_x + v.w * v.w / inertia.inverse_inertia);
            }
            return sum;
        };
        solved += found.error() <= 1e-6 ? 1 : 0;
        EXPECT_LE(found.error(), start.error()) << seed;
        EXPECT_LE(kinetic(found), kinetic(start) * (1.0 + 1e-9)) << seed;
    }
    EXPECT_GE(solved, islands - 2);
}
}  // namespace
}  // namespace hdem
