#include "parallel/static_solver.h"

#include "core/boundary/side_forces.h"
#include "core/contact/block_forces.h"
#include "core/contact/contact_forces.h"
#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"
#include "core/stage/rules.h"
#include "parallel/static_approach.h"
#include "parallel/static_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
namespace
{
constexpr int most_searches = 12;    // for contacts
constexpr Index least_blocks = 200;  // fewer come to rest in less time than a user notices
constexpr int release_parts = 8;  // in which forces of excavated blocks are taken off, where the stage takes them off over cycles
constexpr Index large = 10'000;   // from zero stress Newton by itself takes longer than with cycles in turn

/// Forces by the law of the cycles; the state must be as they would leave it.
Imbalance evaluate_as_in_a_cycle(const Model& model, State& state, const std::vector<Triple>& given,
                                 std::vector<std::uint8_t> is_held)
{
    ContactLoads loads;
    loads.resize(state.contacts.stale.size());
    const RegimeRule rule = resolve_rules(model, state).contact;
    const ContactTally tally = evaluate_contacts({0, state.contacts.size()}, model, rule, state.blocks, state.contacts, loads);
    state.ledger.friction += sum(tally.friction);
    state.ledger.contact_changes += sum(tally.changes);
    state.ledger.dilation += sum(tally.dilation);
    state.ledger.bond_breaking += sum(tally.broken);
    BlockContacts list;
    list_block_contacts(state.contacts, state.blocks.size(), list);
    sum_forces({0, state.blocks.size()}, model, list, loads, given, false, state.blocks);
    std::ranges::replace(is_held, std::uint8_t{frozen}, std::uint8_t{not_held});
    const Unknowns standing = number_unknowns(state, is_held);
    std::vector<double> net(3 * standing.block.size());
    return net_forces({0, static_cast<Index>(standing.block.size())}, model, state, standing, list, loads.load, given, {}, net);
}

void add_effort(const StaticOutcome& other, StaticOutcome& outcome)
{
    outcome.iterations += other.iterations;
    outcome.solves += other.solves;
    outcome.searches += other.searches;
}

double weight_work(const Model& model, const State& before, const State& after)
{
    double work = 0.0;
    for (Index b = 0; b < model.blocks(); ++b)
        if (before.blocks.present[b] != 0)
            work += model.mass[b] * (model.gravity.x() * (after.blocks.motion[b].x - before.blocks.motion[b].x) +
                                     model.gravity.y() * (after.blocks.motion[b].y - before.blocks.motion[b].y));
    return work;
}

/// Search after search for contacts, from a trial state that is at rest. The trial is balanced if the outcome is. Blocks that have come away may stand again once: on
/// its way from far out of balance a search throws some out of places where they can stand.
StaticOutcome search_balance(const Model& model, State& trial, int threads, const StaticRule& rule,
                             const std::vector<Triple>& given)
{
    StaticSearch search(model, trial, threads, rule, given);
    StaticOutcome outcome;
    bool may_stand_again = true;
    while (outcome.searches < most_searches)
    {
        search.find_contacts();
        ++outcome.searches;
        const StaticSearch::End end = search.run();
        outcome.iterations = search.iterations();
        outcome.solves = search.solves();
        outcome.residual = search.ratio();
        outcome.loose = search.loose();
        if (end == StaticSearch::End::gave_up)
        {
            outcome.kind = outcome.loose.empty() ? StaticOutcome::Kind::not_converged : StaticOutcome::Kind::no_equilibrium;
            return outcome;
        }
        search.commit();
        if (may_stand_again && search.let_stand_again())
            may_stand_again = false;
        else if (end != StaticSearch::End::in_balance)
            break;
    }
    stop_all(trial.blocks);
    outcome.residual = evaluate_as_in_a_cycle(model, trial, given, search.is_held()).ratio();
    trial.ledger.friction += search.friction();
    if (outcome.residual <= rule.nearly)
        outcome.kind = outcome.residual <= 2.0 * rule.accepted ? StaticOutcome::Kind::balanced
                                                               : StaticOutcome::Kind::nearly_balanced;
    return outcome;
}

/// Tractions on sides, and a share of what excavated blocks have given to those that stay.
std::vector<Triple> given_forces(const Model& model, const State& state, double share)
{
    if (share == 0.0)
        return constant_forces(model, state);
    std::vector<Triple> given(static_cast<std::size_t>(state.blocks.size()));
    for (const ReleasedForce& force : state.released)
        given[force.block] = {share * force.x, share * force.y, share * force.moment};
    add_constant_forces(model, state, given);
    return given;
}

/// In balance at each share of the forces of excavated blocks, the last of which is none.
StaticOutcome search_balance(const Model& model, State& trial, int threads, const StaticRule& rule)
{
    const int parts = trial.released.empty() ? 1 : release_parts;
    StaticOutcome all;
    for (int part = 1; part <= parts; ++part)
    {
        const std::vector<Triple> given = given_forces(model, trial, 1.0 - static_cast<double>(part) / parts);
        const std::vector<BlockMotion> from = trial.blocks.motion;
        StaticOutcome outcome = search_balance(model, trial, threads, rule, given);
        book_given_work(given, model, trial, from, trial.blocks.motion, trial.ledger);
        add_effort(all, outcome);
        all = std::move(outcome);
        if (!all.is_taken())
            break;
    }
    return all;
}

/// The same after the rounds of an approach.
StaticOutcome approach_and_search(const Model& model, State& trial, int threads, const StaticRule& rule)
{
    trial.released.clear();
    StaticOutcome approach;
    if (!approach_balance(model, trial, threads, rule, approach))
        return approach;
    StaticOutcome outcome = search_balance(model, trial, threads, rule);
    add_effort(approach, outcome);
    return outcome;
}

/// Do the others stand once the blocks that come away have left? Those that lose their hold then leave as well, until none does. Blocks that come away are held where they were,
/// and bear on: what stands by that alone does not stand.
/// @return  all that have left, and whether the others are in balance
StaticOutcome let_leave(const Model& model, State trial, int threads, const StaticRule& rule, const StaticOutcome& held)
{
    StaticOutcome all = held;
    for (std::vector<Index> leaving = held.loose; !leaving.empty();)
    {
        for (const Index b : leaving)
        {
            trial.blocks.present[b] = 0;
            trial.blocks.inertia[b] = {};
        }
        StaticOutcome others = search_balance(model, trial, threads, rule, constant_forces(model, trial));
        add_effort(others, all);
        leaving = others.is_taken() ? others.loose : std::vector<Index>();
        all.loose.insert(all.loose.end(), others.loose.begin(), others.loose.end());
        if (!others.is_taken() || static_cast<double>(all.loose.size()) > rule.most_loose * static_cast<double>(model.blocks()))
        {
            all.kind = others.is_taken() ? StaticOutcome::Kind::no_equilibrium : others.kind;
            break;
        }
    }
    std::ranges::sort(all.loose);
    return all;
}

bool is_large(const State& state)
{
    return state.blocks.size() >= large;
}

State at_rest(const State& state)
{
    State trial = state;
    stop_all(trial.blocks);
    return trial;
}
}  // namespace

StaticRule static_rule(const Model& model)
{
    const ConvergenceDef& convergence = model.convergence;
    return {.ratio = 0.1 * convergence.unbalanced_force_ratio,
            .accepted = convergence.unbalanced_force_ratio,
            .acceleration = 0.1 * convergence.block_unbalanced_ratio * model.gravity.norm()};
}

void stop_if_asked(const StaticRule& rule)
{
    if (rule.is_to_stop && rule.is_to_stop())
        throw BrokenOff{};
}

const char* name_of(StaticOutcome::Kind kind)
{
    constexpr std::array names = {"balanced", "nearly_balanced", "no_equilibrium", "not_converged"};
    return names[static_cast<std::size_t>(kind)];
}

bool can_solve_statics(const Model& model, const State& state)
{
    if (model.joints.has_memory())
        return false;
    for (const std::vector<std::uint8_t>& regimes : state.contacts.regime)
        if (std::ranges::find(regimes, static_cast<std::uint8_t>(Regime::impulse)) != regimes.end())
            return false;
    Index free = 0;
    for (Index b = 0; b < state.blocks.size(); ++b)
        free += state.blocks.is_free(b) ? 1 : 0;
    Equilibrium now;
    add_equilibrium({0, state.blocks.size()}, model, state, ConvergenceBlocks::all, now);
    return free >= least_blocks && now.kinetic_energy <= now.kinetic_energy_at(10.0 * model.convergence.mean_speed);
}

StaticOutcome solve_statics(const Model& model, State& state, int threads, const StaticRule& rule)
{
    const bool approaches_first = is_large(state) && is_unloaded(model, state);
    using Way = StaticOutcome (*)(const Model&, State&, int, const StaticRule&);
    const std::array<Way, 2> ways = approaches_first ? std::array<Way, 2>{approach_and_search, search_balance}
                                                     : std::array<Way, 2>{search_balance, approach_and_search};
    State trial = at_rest(state);
    StaticOutcome outcome = ways[0](model, trial, threads, rule);
    if (!outcome.is_taken())
    {
        trial = at_rest(state);
        StaticOutcome second = ways[1](model, trial, threads, rule);
        add_effort(outcome, second);
        if (second.is_taken() || outcome.kind == StaticOutcome::Kind::not_converged)
            outcome = std::move(second);
    }
    if (!outcome.is_taken())
        return outcome;
    const StaticOutcome after = let_leave(model, trial, threads, rule, outcome);
    if (!after.is_taken())
        return after;
    outcome.iterations = after.iterations;
    outcome.solves = after.solves;
    outcome.searches = after.searches;
    trial.released.clear();
    trial.ledger.gravity_work = state.ledger.gravity_work + weight_work(model, state, trial);
    trial.ledger.local_damping += residual(trial.ledger, stored_energy(model, trial)) -
                                  residual(state.ledger, stored_energy(model, state));
    state = std::move(trial);
    return outcome;
}
}  // namespace hdem
