#include "parallel/simulation.h"

#include "core/detection/contact_tracking.h"
#include "core/energy_ledger.h"
#include "core/motion/loads.h"
#include "core/motion/released_forces.h"
#include "core/motion/rest.h"
#include "core/motion/time_step.h"
#include "core/observer.h"
#include "core/rock/build_model.h"
#include "core/stage/load_changes.h"
#include "core/stage/properties.h"
#include "core/state/block_sorting.h"
#include "core/stress/drawn_joints.h"
#include "core/water/water_forces.h"
#include "parallel/state_check.h"

#include <algorithm>
#include <utility>

namespace hdem
{
Simulation::Simulation(Model model, State state, const ThreadRule& threads)
    : model_(std::move(model)),
      state_(std::move(state)),
      threads_(threads)
{
    const bool fresh = state_.broad_phase_runs == 0;  // and not from a checkpoint
    for (Index stage = 0; state_.stage_begun && stage <= state_.stage; ++stage)
    {
        joints_before_ = {model_.joints.laws, model_.joints.rows};
        set_properties(model_, stage);
    }
    if (state_.contacts_outdated)
        renew_contacts();
    if (fresh)
    {
        renew_water();
        join_drawn_blocks(model_, std::vector<std::uint8_t>(static_cast<std::size_t>(model_.blocks()), 1), state_);
        const StoredEnergy stored = stored_energy(model_, state_);
        (model_.insitu.given ? state_.ledger.insitu : state_.ledger.initial) = stored.total() - stored.kinetic;
        state_.ledger.initial += stored.kinetic;
        find_default_step();
    }
    else if (state_.default_step > 0.0)
    {
        model_.time_step = model_.default_time_step = state_.default_step;
        time_loads(model_);
    }
    runner_.forget_times();
}

void Simulation::hold_lost_blocks()
{
    std::vector<Index> lost;
    for (Index i = 0; i < model_.blocks(); ++i)
        if (state_.blocks.is_free(i) && has_left(i, model_, state_.blocks))
            lost.push_back(i);
    if (lost.empty())
        return;
    remove_energy(
        [&]
        {
            for (const Index block : lost)
                set_mobility(model_, block, false, state_.blocks);
            renew_contacts();  // two blocks that are held have no contact: what their joint stores goes, too
        });
}

std::optional<EndMet> Simulation::look_at_ends(bool is_settled)
{
    if (!ends_)
        ends_.emplace(model_, state_.stage);
    return ends_->look(model_, state_, is_settled);
}

void Simulation::note_outcome(const StageOutcome& outcome, const std::vector<Index>& not_at_rest)
{
    state_.stages_done.push_back(outcome);
    for (const Index block : not_at_rest)
        state_.not_at_rest.push_back({.stage = state_.stage, .block = block});
}

void Simulation::change_motion(const std::function<void(std::vector<BlockMotion>&)>& change)
{
    const double stored = stored_energy(model_, state_).total();
    const double changes = state_.ledger.contact_changes;
    change(state_.blocks.motion);
    wake_all(state_.blocks);
    state_.rest_changed = true;
    state_.is_calm = false;
    state_.flies_ahead = false;
    state_.quiet_since = -1.0;
    state_.statics_taken = false;
    state_.blocks.step.next = model_.time_step;
    renew_contacts();
    state_.ledger.load_work += stored_energy(model_, state_).total() - stored - (state_.ledger.contact_changes - changes);
}

void Simulation::set_joints()
{
    const auto stage = static_cast<std::size_t>(state_.stage);
    if (state_.stage_begun && stage < model_.stage_laws.size() && !model_.stage_laws[stage].laws.empty() &&
        sets_over_time(model_.stages[stage]))
        set_joints_between(joints_before_, state_.stage, share_set(model_, state_), model_);
}

void Simulation::end_released_forces()
{
    if (state_.released.empty())
        return;
    state_.released.clear();
    runner_.take_contacts();  // what they gave in the last cycle acts no more
}

void Simulation::advance(std::int64_t cycles)
{
    for (const std::int64_t end = state_.cycle + cycles; state_.cycle < end;)
    {
        if (state_.contacts_outdated)
            renew_contacts();
        std::int64_t stop = are_forces_released(model_, state_) ? std::min(end, released_until(model_, state_)) : end;
        if (const std::int64_t steady = steady_from(model_, state_); steady > state_.cycle)  // other rules hold from there on
            stop = std::min(stop, steady);
        if (is_setting_joints(model_, state_))
            stop = std::min(stop, next_share(model_, state_));
        if (model_.water.given)
            stop = std::min(stop, state_.water_until);
        set_joints();
        if (const Index stiff = runner_.run(model_, state_, stop - state_.cycle, threads_); stiff != no_index)
            refuse_step(model_, state_, stiff);
        if (!are_forces_released(model_, state_) && model_.stages[static_cast<std::size_t>(state_.stage)].relax_to == 0.0)
            end_released_forces();
        if (runner_.found_deep_overlap())
            refuse_overlap(model_, state_);
        if (model_.water.given && state_.cycle == state_.water_until)
        {
            renew_water();
            runner_.take_contacts();
        }
    }
}

void Simulation::renew_water()
{
    const WaterRule rule = resolve_rules(model_, state_).water;
    state_.water.resize(model_.water.given ? static_cast<std::size_t>(model_.blocks()) : 0);
    state_.water_until = model_.water.given ? water_holds_until(model_, state_, rule) : 0;
    state_.water = water_forces(model_, state_, state_.water_until, rule.drag);
}

void Simulation::renew_contacts()
{
    if (is_order_decayed(model_, state_))
        sort_blocks(model_, state_);
    runner_.renew_contacts(model_, state_, threads_.threads());
}

}  // namespace hdem
