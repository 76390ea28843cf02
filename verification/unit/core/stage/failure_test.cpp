#include "core/stage/failure.h"
#include "io/case_reader.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
constexpr const char* block_on_ground = R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = 30.0
[[block]]
name = "ground"
polygon = [[-5, -1], [30, -1], [30, 0], [-5, 0]]
fixed = true
[[block]]
name = "block"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[stage]]
cycles = 10
)";

/// A block that is moved by hand; its L is 0.02 m.
struct Moved
{
    test::CaseRun run{read_case_text(block_on_ground, "case.toml").def};
    State state = run.state();
    FailureWatch watch{FailureRule{}, run.model(), state};
    Index block = run.model().find_block("block");
    Index user = run.model().user_number[block];

    /// Looks every 0.01 s up to a time; @return  way at which the block failed, or 0.
    template <typename Way>
    double go(const Way& way, double until)
    {
        const double x = state.blocks.motion[block].x, begin = state.time;
        for (int k = 1; 0.01 * k <= until; ++k)
        {
            state.time = begin + 0.01 * k;
            state.blocks.motion[block].x = x + way(0.01 * k);
            if (!watch.look(run.model(), state).empty())
                return way(0.01 * k);
        }
        return 0.0;
    }
};

TEST(FailureWatch, AConstantForceFailsWhereItPassesTheLimit)
{
    Moved moved;
    EXPECT_NEAR(moved.watch.limit(moved.user), 0.02, 1e-12);
    EXPECT_NEAR(moved.go([](double t) { return 0.5 * 0.05 * t * t; }, 10.0), 0.02, 1e-3);
}

/// A soft bolt holds with its strength once it is stretched.
TEST(FailureWatch, WaitsForBoltsToYield)
{
    for (const auto& [stiffness, limit] : {std::pair("1e9", 0.02), std::pair("1e6", 4.0 * 0.05)})
    {
        const std::string bolt = std::string(
                                     "[[bolt]]\nname = \"b\"\nfrom = [0.5, 0.5]\nto = [0.5, -0.5]\nyield = 5e4\nstiffness = ") +
                                 stiffness;
        const test::CaseRun run(read_case_text(block_on_ground + bolt, "case.toml").def);
        const FailureWatch watch(FailureRule{}, run.model(), run.state());
        EXPECT_NEAR(watch.limit(run.model().user_number[run.model().find_block("block")]), limit, 1e-12);
    }
}

TEST(FailureWatch, WhatSlowsDownHasNotFailed)
{
    Moved moved;
    EXPECT_EQ(moved.go([](double t) { return 0.03 * (1.0 - std::exp(-2.0 * t)); }, 10.0), 0.0);
    EXPECT_GT(moved.watch.farthest().moved, moved.watch.farthest().limit);
}

TEST(FailureWatch, EightTimesTheLimitIsTooFarHoweverSlow)
{
    Moved moved;
    EXPECT_NEAR(moved.go([](double t) { return 0.01 * t; }, 30.0), 0.16, 1e-3);
}

TEST(FailureWatch, SwingingOnSpringsDoesNotMatter)
{
    Moved moved;
    EXPECT_EQ(moved.go([](double t) { return 1e-3 * (1.0 - std::cos(300.0 * t)); }, 10.0), 0.0);
}

TEST(FailureWatch, CreepIsSeenBeforeTheLimit)
{
    for (const double power : {1.0, 2.0})
    {
        Moved moved;
        double from = 0.0;
        const auto way = [&](double t) { return 1e-3 * std::pow(from + t, power) / std::pow(8.0, power - 1.0); };
        Index creeping = no_index;
        for (const double until : {1.0, 1.0, 2.0, 4.0})  // at 1, 2, 4 and 8 s
        {
            const double begun = from;
            moved.go([&](double t) { return way(t) - way(0.0); }, until);
            from = begun + until;
            creeping = moved.watch.find_creeping();
        }
        EXPECT_EQ(creeping, moved.user) << power;
    }
    Moved settles;
    for (int k = 0; k < 5; ++k)
    {
        settles.go([](double) { return 1e-5; }, 0.1);
        EXPECT_EQ(settles.watch.find_creeping(), no_index);
    }
}
}  // namespace
}  // namespace hdem
