/// Static solutions: at the beginning of a stage, and later in it.

#include "core/stage/rules.h"
#include "parallel/simulation.h"

#include <algorithm>
#include <utility>

namespace hdem
{
void Simulation::solve_due_statics()
{
    if (!state_.statics_due)
        return;
    solve_statics();
    state_.statics.push_back(
        {.stage = state_.stage, .end = statics_->kind, .iterations = statics_->iterations, .residual = statics_->residual});
    for (const Index block : statics_->loose)
        state_.came_loose.push_back({.stage = state_.stage, .block = model_.user_number[block]});
    std::ranges::sort(state_.came_loose);
}

void Simulation::solve_statics()
{
    StaticRule rule = static_rule(model_);
    rule.is_to_stop = is_to_stop_;
    int iteration = 0;
    if (follow_)
        rule.tell = [this, &iteration](double ratio) { follow_(++iteration, ratio); };
    state_.statics_due = true;
    statics_ = hdem::solve_statics(model_, state_, threads_.threads(), rule);
    state_.statics_due = false;
    if (!statics_->is_taken())
        return;
    state_.statics_taken = true;
    state_.released.clear();
    state_.contacts_outdated = false;
    runner_.take_contacts();  // found anew, some would have other features, which bear otherwise
}

void Simulation::finish_by_statics()
{
    if (!resolve_rules(model_, state_).tries_statics || !state_.released.empty() || state_.statics_taken ||
        !can_solve_statics(model_, state_) || equilibrium().fastest.value >= model_.convergence.mean_speed)
        return;
    State before = state_;
    before.statics_due = false;
    solve_statics();
    if (statics_->is_taken() && !statics_->loose.empty())
    {
        state_ = std::move(before);  // what slides slowly is not stopped on its way
        runner_.renew_contacts(model_, state_, threads_.threads());
    }
}
}  // namespace hdem
