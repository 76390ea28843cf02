#include "parallel/static_ways.h"

#include "core/boundary/side_forces.h"
#include "core/contact/block_forces.h"
#include "core/contact/contact_forces.h"
#include "core/stage/rules.h"
#include "parallel/static_approach.h"
#include "parallel/static_search.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr int most_searches = 12;  // for contacts
constexpr int parts = 8;           // in which forces are let go

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

}  // namespace

void add_effort(const StaticOutcome& other, StaticOutcome& outcome)
{
    outcome.iterations += other.iterations;
    outcome.solves += other.solves;
    outcome.searches += other.searches;
}

SearchOutcome search_balance(const Model& model, State& trial, int threads, const StaticRule& rule,
                             const std::vector<Triple>& given)
{
    StaticSearch search(model, trial, threads, rule, given);
    SearchOutcome outcome;
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
        outcome.has_begun_again = search.has_begun_again();
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

namespace
{
/// In parts, from balance to balance: `held` is what holds the blocks where they are, besides tractions on sides, and is let go.
/// @param is_load  are they forces of the case, whose work is that of a load?
StaticOutcome let_go(const Model& model, State& trial, int threads, const StaticRule& rule, const std::vector<Triple>& held,
                     bool is_load)
{
    StaticOutcome all;
    for (int part = 1; part <= parts; ++part)
    {
        const double share = 1.0 - static_cast<double>(part) / parts;
        const std::vector<Triple> constant = constant_forces(model, trial);
        std::vector<Triple> given(held.size());
        for (std::size_t b = 0; b < held.size(); ++b)
            given[b] = {share * held[b].x, share * held[b].y, share * held[b].w};
        add_constant_forces(model, trial, given);
        const std::vector<BlockMotion> from = trial.blocks.motion;
        StaticOutcome outcome = search_balance(model, trial, threads, rule, part < parts ? given : constant);
        book_given_work(is_load ? given : constant, model, trial, from, trial.blocks.motion, trial.ledger);
        add_effort(all, outcome);
        all = std::move(outcome);
        if (!all.is_taken())
            break;
    }
    return all;
}

}  // namespace

SearchOutcome search_at_once(const Model& model, State& trial, int threads, const StaticRule& rule)
{
    const std::vector<Triple> given = constant_forces(model, trial);
    const std::vector<BlockMotion> from = trial.blocks.motion;
    SearchOutcome outcome = search_balance(model, trial, threads, rule, given);
    book_given_work(given, model, trial, from, trial.blocks.motion, trial.ledger);
    return outcome;
}

StaticOutcome search_in_parts(const Model& model, State& trial, int threads, const StaticRule& rule)
{
    std::vector<Triple> held;
    {
        State start = trial;
        StaticSearch search(model, start, threads, rule, constant_forces(model, start));
        search.find_contacts();
        held = search.net_forces_at_start();
    }
    for (Triple& force : held)
        force = {-force.x, -force.y, -force.w};
    return let_go(model, trial, threads, rule, held, false);
}

StaticOutcome take_off_released(const Model& model, State& trial, int threads, const StaticRule& rule)
{
    std::vector<Triple> held(static_cast<std::size_t>(trial.blocks.size()));
    for (const ReleasedForce& force : trial.released)
        held[force.block] = {force.x, force.y, force.moment};
    return let_go(model, trial, threads, rule, held, true);
}

StaticOutcome approach_and_search(const Model& model, State& trial, int threads, const StaticRule& rule)
{
    trial.released.clear();
    StaticOutcome approach;
    if (!approach_balance(model, trial, threads, rule, approach))
        return approach;
    StaticOutcome outcome = search_at_once(model, trial, threads, rule);
    add_effort(approach, outcome);
    return outcome;
}
}  // namespace hdem
