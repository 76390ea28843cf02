#include "parallel/static_approach.h"
#include "parallel/static_search.h"
#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using test::CaseRun;

CaseDef rock(Method method)
{
    CaseDef scene = scenes::three_joint_sets(1.7, 35.0, 1e5);
    scene.contact.method = method;
    scene.stages = {{.name = "rest", .until_converged = true, .solver = RestSolver::dynamics}};
    return scene;
}

/// Rock from zero stress after an approach.
struct Approach
{
    explicit Approach(Method method, int threads = 1) : run(rock(method)), state(run.state())
    {
        stop_all(state.blocks);
        near = approach_balance(run.model(), state, threads, static_rule(run.model()), outcome);
    }

    CaseRun run;
    State state;
    StaticOutcome outcome;
    bool near = false;
};

TEST(StaticApproach, BringsUnloadedRockNearBalance)
{
    const Approach approach(Method::force);
    ASSERT_TRUE(approach.near);
    EXPECT_TRUE(is_unloaded(approach.run.model(), approach.run.state()));
    EXPECT_FALSE(is_unloaded(approach.run.model(), approach.state));
    EXPECT_GT(approach.outcome.iterations, 0);
    Equilibrium now;
    add_equilibrium({0, approach.state.blocks.size()}, approach.run.model(), approach.state, ConvergenceBlocks::all, now);
    EXPECT_LT(now.unbalanced_force_ratio(), 1e-2);
    EXPECT_EQ(now.kinetic_energy, 0.0);
}

TEST(StaticApproach, TheClockOfTheRunStandsStill)
{
    const Approach approach(Method::hybrid);
    const State& before = approach.run.state();
    EXPECT_EQ(approach.state.cycle, before.cycle);
    EXPECT_EQ(approach.state.time, before.time);
    EXPECT_EQ(approach.state.blocks.step.next, before.blocks.step.next);
    EXPECT_EQ(approach.state.method, Method::hybrid);
}

TEST(StaticApproach, GoesBySpringsWhateverTheMethod)
{
    const Approach force(Method::force), hybrid(Method::hybrid);
    EXPECT_EQ(force.outcome.iterations, hybrid.outcome.iterations);
    for (Index b = 0; b < force.state.blocks.size(); ++b)
        EXPECT_EQ(force.state.blocks.displacement(b), hybrid.state.blocks.displacement(b)) << b;
}

TEST(StaticApproach, GivesTheSameBitsOnAnyNumberOfThreads)
{
    const Approach one(Method::force, 1), three(Method::force, 3);
    EXPECT_EQ(one.outcome.iterations, three.outcome.iterations);
    EXPECT_EQ(state_hash(one.run.model(), one.state), state_hash(three.run.model(), three.state));
}
}  // namespace
}  // namespace hdem
