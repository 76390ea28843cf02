#include "parallel/simulation.h"

#include "core/boundary/servo.h"
#include "core/boundary/switch_boundaries.h"
#include "core/detection/contact_tracking.h"
#include "core/detection/edge_touch.h"
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
#include "core/support/bolt_forces.h"
#include "core/support/bolt_springs.h"
#include "core/support/liner_forces.h"
#include "core/water/water_forces.h"
#include "parallel/state_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hdem
{
namespace
{
void remove_block(Index block, Blocks& blocks)
{
    blocks.present[block] = 0;
    blocks.inertia[block] = {};
    blocks.motion[block].vx = blocks.motion[block].vy = blocks.motion[block].w = 0.0;
}
/// Of excavated blocks and of sides that have ended.
void end_released_forces(State& state, CycleRunner& runner)
{
    if (state.released.empty())
        return;
    state.released.clear();
    runner.take_contacts();  // what they gave in the last cycle acts no more
}
}  // namespace

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
        state_.water = water_forces(model_, state_);
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

void Simulation::excavate(const std::string& name)
{
    const auto at = std::find(model_.excavation_names.begin(), model_.excavation_names.end(), name);
    const Index excavation = at == model_.excavation_names.end() ? no_index
                                                                 : static_cast<Index>(at - model_.excavation_names.begin());
    const Index single = excavation == no_index ? model_.find_block(name) : no_index;
    std::vector<std::uint8_t> removed(static_cast<std::size_t>(model_.blocks()), 0);
    for (Index i = 0; i < model_.blocks(); ++i)
        removed[i] = (excavation != no_index && model_.excavation[i] == excavation) || i == single;

    if (model_.stages[state_.stage].relax_cycles > 0)
        release_forces(removed, state_);
    const Contacts& contacts = state_.contacts;
    std::vector<Index>& near = state_.next_to_excavation;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index ref = contacts.ref[i];
        const Index inc = contacts.inc[i];
        if (removed[ref] == removed[inc])
            continue;
        // Faces that lay against what is removed, whether or not they carried force.
        const EdgeTouch touch = touch_edges(contacts.edges(i), state_.blocks.motion[ref], state_.blocks.motion[inc]);
        const double gap = -std::max(touch.point[0].overlap, touch.point[1].overlap);
        if (touch.length > contacts.length_floor(i) && gap < contacts.length_floor(i))
            near.push_back(removed[ref] != 0 ? inc : ref);
    }
    for (Index i = 0; i < model_.blocks(); ++i)
        if (removed[i] != 0)
            remove_block(i, state_.blocks);
    std::erase_if(near, [&](Index i) { return state_.blocks.present[i] == 0; });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    state_.contacts_outdated = true;
    state_.excavation_cycle = state_.cycle;
}

void Simulation::take_away(const std::vector<Index>& blocks)
{
    const double stored = stored_energy(model_, state_).total();
    const double changes = state_.ledger.contact_changes;
    for (const Index block : blocks)
        remove_block(block, state_.blocks);
    std::erase_if(state_.next_to_excavation, [&](Index i) { return state_.blocks.present[i] == 0; });
    wake_all(state_.blocks);
    state_.rest_changed = true;
    renew_contacts();
    state_.ledger.removed += stored - stored_energy(model_, state_).total() - (state_.ledger.contact_changes - changes);
}

void Simulation::change_sides(const BoundaryChange& sides)
{
    if (!sides.ends.empty() && model_.stages[state_.stage].relax_cycles > 0)
        release_forces(sides.ends, state_);
    remove_walls(sides.ends, state_);
    place_walls(model_, state_);
    for (const Index block : sides.held)
        set_mobility(model_, block, false, state_.blocks);
    for (const Index block : sides.freed)
        if (state_.blocks.present[block] != 0)
            set_mobility(model_, block, true, state_.blocks);
    if (sides.any())
        state_.contacts_outdated = true;
}

void Simulation::change_blocks(const StageDef& stage, const BoundaryChange& sides)
{
    const double stored = stored_energy(model_, state_).total();
    const double changes = state_.ledger.contact_changes;
    std::vector<std::uint8_t> was_fixed;
    for (Index i = 0; i < model_.blocks(); ++i)
        was_fixed.push_back(state_.blocks.is_free(i) ? 0 : 1);
    for (const Index wall : sides.begins)
        was_fixed[wall] = 0;  // it touches the rock without force
    change_sides(sides);
    for (const std::string& name : stage.excavate)
        excavate(name);
    for (const std::string& name : stage.fix)
        set_mobility(model_, model_.find_block(name), false, state_.blocks);
    for (const std::string& name : stage.free)
        set_mobility(model_, model_.find_block(name), true, state_.blocks);
    if (!stage.fix.empty() || !stage.free.empty())
        state_.contacts_outdated = true;
    if (state_.contacts_outdated)
        renew_contacts();
    if (!stage.free.empty() || !sides.freed.empty())  // between two fixed blocks there was no contact
        join_drawn_blocks(model_, was_fixed, state_);
    state_.ledger.removed += stored - stored_energy(model_, state_).total() - (state_.ledger.contact_changes - changes);
}

void Simulation::change_water()
{
    if (!model_.water.given)
        return;
    const std::vector<Triple> before = std::exchange(state_.water, water_forces(model_, state_));
    if (model_.stages[state_.stage].relax_cycles > 0)
        release_water(before, state_);
    runner_.take_contacts();
}

void Simulation::change_properties()
{
    if (!changes_properties(model_, state_.stage))
        return;
    joints_before_ = {model_.joints.laws, model_.joints.rows};
    const double stored = stored_energy(model_, state_).total();
    const std::vector<double> density = model_.density;
    set_properties(model_, state_.stage);
    const bool stiffness_changes = keep_forces(joints_before_, model_, state_);
    renew_inertia(model_, state_.blocks);
    if (stiffness_changes || density != model_.density)
        state_.contacts_outdated = true;  // the step is found anew
    state_.ledger.property_changes += stored - stored_energy(model_, state_).total();
    check_preload(model_, state_);
    set_joints();
}

void Simulation::set_joints()
{
    const auto stage = static_cast<std::size_t>(state_.stage);
    if (state_.stage_begun && stage < model_.stage_laws.size() && !model_.stage_laws[stage].laws.empty() &&
        model_.stages[stage].set_cycles > 0)
        set_joints_between(joints_before_, state_.stage, share_set(model_, state_), model_);
}

void Simulation::begin_stage(Index stage)
{
    const StageDef& def = model_.stages[stage];
    const Index before = state_.stage;
    const BoundaryChange sides = boundary_change(model_, before, stage);
    if (state_.stage_begun)
        set_properties(model_, before);  // to the end, where it was too short for its set_cycles
    if (state_.stage_begun && def.relax_cycles > 0 && model_.stages[before].relax_to > 0.0)
        keep_released_forces(model_, state_);
    else
        end_released_forces(state_, runner_);
    state_.stage = stage;
    state_.stage_begun = true;
    state_.stage_begin_cycle = state_.cycle;
    change_properties();
    state_.quiet_since = -1.0;
    state_.ends.assign(def.ends.size(), {});
    ends_.reset();
    state_.is_calm = false;
    state_.flies_ahead = false;
    state_.rest_changed = true;  // who was left out takes part again
    state_.statics_due = false;
    state_.statics_taken = false;
    state_.blocks.step.next = model_.time_step;
    std::ranges::fill(state_.blocks.stable_step, 0.0);  // of another stage; looked at where steps first vary
    state_.moving.clear();
    wake_all(state_.blocks);
    if (def.relax_cycles > 0)
        release_tractions(model_, before, stage, state_);
    if (state_.contacts_outdated || !def.excavate.empty() || !def.fix.empty() || !def.free.empty() || sides.any())
        change_blocks(def, sides);
    change_water();
    const bool bolted = install_bolts(model_, state_), lined = install_liners(model_, state_);
    if (bolted || lined)
        runner_.take_contacts();
    start_walls(model_, state_);
    state_.method = def.method.value_or(state_.method);
    state_.damping = def.damping.value_or(state_.damping);
    for (Index i = 0; i < model_.blocks(); ++i)
    {
        state_.blocks.reference_position[i] = {state_.blocks.motion[i].x, state_.blocks.motion[i].y};
        state_.blocks.reference_angle[i] = state_.blocks.motion[i].angle;
    }
    statics_.reset();
    state_.statics_due = resolve_rules(model_, state_).tries_statics && can_solve_statics(model_, state_);
    solve_due_statics();
}

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

void Simulation::hold_lost_blocks()
{
    for (Index i = 0; i < model_.blocks(); ++i)
        if (state_.blocks.is_free(i) && has_left(i, model_, state_.blocks))
        {
            state_.ledger.removed += kinetic_energy(model_, state_.blocks, i);
            set_mobility(model_, i, false, state_.blocks);
            state_.contacts_outdated = true;
        }
    if (state_.contacts_outdated)
        renew_contacts();
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
            stop = std::min(stop, next_multiple(state_.cycle, water_every));
        set_joints();
        if (const Index stiff = runner_.run(model_, state_, stop - state_.cycle, threads_); stiff != no_index)
            refuse_step(model_, state_, stiff);
        if (!are_forces_released(model_, state_) && model_.stages[static_cast<std::size_t>(state_.stage)].relax_to == 0.0)
            end_released_forces(state_, runner_);
        if (runner_.found_deep_overlap())
            refuse_overlap(model_, state_);
        if (model_.water.given && state_.cycle % water_every == 0)
        {
            state_.water = water_forces(model_, state_);
            runner_.take_contacts();
        }
    }
}

void Simulation::renew_contacts()
{
    if (is_order_decayed(model_, state_))
        sort_blocks(model_, state_);
    runner_.renew_contacts(model_, state_, threads_.threads());
}

}  // namespace hdem
