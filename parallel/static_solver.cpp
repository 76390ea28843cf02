#include "parallel/static_solver.h"

#include "core/boundary/side_forces.h"
#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"
#include "core/statics/static_blocks.h"
#include "parallel/static_approach.h"
#include "parallel/static_ways.h"

#include <algorithm>
#include <array>

namespace hdem
{
namespace
{
constexpr Index large = 10'000;  // from zero stress Newton by itself takes longer than with cycles in turn

double weight_work(const Model& model, const State& before, const State& after)
{
    double work = 0.0;
    for (Index b = 0; b < model.blocks(); ++b)
        if (before.blocks.present[b] != 0)
            work += model.mass[b] * (model.gravity.x() * (after.blocks.motion[b].x - before.blocks.motion[b].x) +
                                     model.gravity.y() * (after.blocks.motion[b].y - before.blocks.motion[b].y));
    return work;
}

/// Do the other blocks stand once the blocks that come away have left? Blocks that lose their hold then leave as well, until none does. (During the
/// search, blocks that come away are held where they were, and still bear others. What stands by them alone does not stand.)
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

using Way = StaticOutcome (*)(const Model&, State&, int, const StaticRule&);

StaticOutcome try_way(Way way, const Model& model, const State& state, int threads, const StaticRule& rule, State& trial)
{
    trial = at_rest(state);
    return way(model, trial, threads, rule);
}

/// From zero stress. Weight that acts all at once can end in a balance that rock does not come to, with joints open that bear load where weight grows; the rock then falls
/// at the next excavation. So it acts in parts. Large models take too long by that: they come near their balance by cycles first.
StaticOutcome solve_unloaded(const Model& model, const State& state, int threads, const StaticRule& rule, State& trial)
{
    const bool approaches_first = is_large(state);
    StaticOutcome outcome = try_way(approaches_first ? approach_and_search : search_in_parts, model, state, threads, rule, trial);
    if (outcome.is_taken())
        return outcome;
    StaticOutcome second = try_way(approaches_first ? search_in_parts : approach_and_search, model, state, threads, rule, trial);
    add_effort(outcome, second);
    return second.is_taken() || outcome.kind == StaticOutcome::Kind::not_converged ? second : outcome;
}

/// Has the rock lost more by slip than all of its joints hold in shear?
bool has_slid(const Model& model, const State& before, const State& after)
{
    return after.ledger.friction - before.ledger.friction > stored_energy(model, after).elastic_shear;
}

/// A step of Newton may carry blocks past joints that would have held them, though none comes away. Cycles come to the balance before; of the two, that with less slip is nearer to the start.
StaticOutcome with_less_slip(const Model& model, const State& state, int threads, const StaticRule& rule, StaticOutcome found,
                             State& trial)
{
    State near;
    StaticOutcome outcome = try_way(approach_and_search, model, state, threads, rule, near);
    if (!outcome.is_taken() || near.ledger.friction >= trial.ledger.friction)
    {
        add_effort(outcome, found);
        return found;
    }
    add_effort(found, outcome);
    trial = std::move(near);
    return outcome;
}

/// From rock that bears its weight, as after an excavation. Where one search has to begin again it may end in a balance that the rock does not come to:
/// then what is out of balance is let go in parts, and where there is none on that way there is none.
StaticOutcome solve_loaded(const Model& model, const State& state, int threads, const StaticRule& rule, State& trial)
{
    trial = at_rest(state);
    if (!state.released.empty())
        return take_off_released(model, trial, threads, rule);
    SearchOutcome outcome = search_at_once(model, trial, threads, rule);
    if (outcome.is_taken() && !outcome.has_begun_again)
        return outcome.loose.empty() && has_slid(model, state, trial) ? with_less_slip(model, state, threads, rule, outcome, trial)
                                                                      : outcome;
    StaticOutcome in_parts = try_way(search_in_parts, model, state, threads, rule, trial);
    add_effort(outcome, in_parts);
    if (in_parts.kind == StaticOutcome::Kind::not_converged && outcome.kind == StaticOutcome::Kind::no_equilibrium)
    {
        in_parts.kind = outcome.kind;
        in_parts.loose = outcome.loose;
    }
    return in_parts;
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
    return free >= least_static_blocks && now.kinetic_energy <= now.kinetic_energy_at(10.0 * model.convergence.mean_speed);
}

StaticOutcome solve_statics(const Model& model, State& state, int threads, const StaticRule& rule)
{
    State trial;
    StaticOutcome outcome = is_unloaded(model, state) && state.released.empty() ? solve_unloaded(model, state, threads, rule, trial)
                                                                                : solve_loaded(model, state, threads, rule, trial);
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
