#include "parallel/static_approach.h"

#include "core/boundary/side_forces.h"
#include "core/motion/equilibrium.h"
#include "core/motion/rest.h"
#include "core/stage/rules.h"
#include "parallel/cycle.h"
#include "parallel/static_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr int most_rounds = 30;
constexpr int iterations_a_round = 5;
constexpr std::int64_t cycles_a_round = 500;
constexpr std::int64_t cycles_unasked = 50;  // in which nobody is asked whether to stop
constexpr double near_balance = 1e-3;        // unbalanced ratio after the cycles of a round
constexpr double passable = 1e-2;    // the same, where rounds bring nothing any more: few blocks that still fall may be held
constexpr int looks_back = 4;        // rounds in which it must have fallen
constexpr double enough_gain = 0.7;  // to this

/// What cycles change besides places and forces.
struct Clock
{
    std::int64_t cycle;
    double time;
    Steps step;
};

/// Damped cycles by springs, from rest to rest. The clock of the run stands still.
/// @return  unbalanced ratio of the last cycle; infinite if a block has gone too deep, or the step was too great for a spring
double run_cycles(const Model& model, State& state, int threads, const StaticRule& rule, CycleRunner& runner)
{
    const Clock before{state.cycle, state.time, state.blocks.step};
    const std::int64_t end = state.cycle + cycles_a_round;
    state.contacts_outdated = true;
    while (state.cycle < end)
    {
        if (state.contacts_outdated)
            runner.renew_contacts(model, state, threads);
        stop_if_asked(rule);
        if (runner.run(model, state, std::min(end - state.cycle, cycles_unasked), threads) != no_index ||
            runner.found_deep_overlap())
            return std::numeric_limits<double>::infinity();
    }
    Equilibrium now;
    add_equilibrium({0, state.blocks.size()}, model, state, ConvergenceBlocks::all, now);
    stop_all(state.blocks);
    state.cycle = before.cycle;
    state.time = before.time;
    state.blocks.step = before.step;
    state.rest_changed = false;
    return now.unbalanced_force_ratio();
}
}  // namespace

bool is_unloaded(const Model& model, const State& state)
{
    double weight = 0.0, borne = 0.0;
    for (Index b = 0; b < state.blocks.size(); ++b)
        weight += state.blocks.is_free(b) ? model.mass[b] * model.gravity.norm() : 0.0;
    for (Index i = 0; i < state.contacts.size(); ++i)
        borne += state.contacts.normal_force(0, i) + state.contacts.normal_force(1, i);
    return borne < 0.5 * weight;
}

bool approach_balance(const Model& model, State& state, int threads, const StaticRule& rule, StaticOutcome& outcome)
{
    CycleRunner runner(approach_rules);
    std::vector<double> ratios;
    StaticRule few = rule;
    few.most_iterations = iterations_a_round;
    while (static_cast<int>(ratios.size()) < most_rounds)
    {
        const std::vector<Triple> given = constant_forces(model, state);
        const std::vector<BlockMotion> from = state.blocks.motion;
        StaticSearch search(model, state, threads, few, given);
        search.find_contacts();
        search.advance();
        ++outcome.searches;
        outcome.iterations += search.iterations();
        outcome.solves += search.solves();
        if (!std::isfinite(search.ratio()))
            return false;
        search.commit();
        state.ledger.friction += search.friction();
        book_given_work(given, model, state, from, state.blocks.motion, state.ledger);
        stop_all(state.blocks);
        if (search.ratio() < near_balance)
            return true;
        const double ratio = run_cycles(model, state, threads, rule, runner);
        if (!std::isfinite(ratio))
            return false;
        if (ratio < near_balance)
            return true;
        ratios.push_back(ratio);
        const std::size_t n = ratios.size();
        if (n > looks_back && ratio > enough_gain * ratios[n - 1 - looks_back])
            return ratio < passable;
    }
    return ratios.back() < passable;
}

void stop_all(Blocks& blocks)
{
    for (Index b = 0; b < blocks.size(); ++b)
        if (blocks.is_free(b))
            blocks.motion[b].vx = blocks.motion[b].vy = blocks.motion[b].w = 0.0;
    wake_all(blocks);
}
}  // namespace hdem
