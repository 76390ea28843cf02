/// What a stage changes as it begins: blocks that are removed, fixed or freed, sides, water, properties, support.

#include "core/boundary/servo.h"
#include "core/boundary/switch_boundaries.h"
#include "core/detection/edge_touch.h"
#include "core/energy_ledger.h"
#include "core/model/block_order.h"
#include "core/motion/released_forces.h"
#include "core/motion/rest.h"
#include "core/rock/build_model.h"
#include "core/stage/properties.h"
#include "core/stage/rules.h"
#include "core/stress/drawn_joints.h"
#include "core/support/bolt_forces.h"
#include "core/support/installed_support.h"
#include "core/support/liner_forces.h"
#include "core/water/water_forces.h"
#include "parallel/simulation.h"
#include "parallel/state_check.h"

#include <algorithm>
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

/// Forget what was found of the rock in the stage before: it is no longer valid.
void forget_stage(const StageDef& def, double time_step, State& state)
{
    state.quiet_since = -1.0;
    state.ends.assign(def.ends.size(), {});
    state.is_calm = false;
    state.flies_ahead = false;
    state.rest_changed = true;  // who was left out takes part again
    state.statics_due = false;
    state.statics_taken = false;
    state.blocks.step.next = time_step;
    state.moving.clear();
    state.creeping.clear();
    wake_all(state.blocks);
}

/// Displacements are counted from here on.
void count_ways_anew(Blocks& blocks)
{
    for (Index i = 0; i < blocks.size(); ++i)
    {
        blocks.reference_position[i] = {blocks.motion[i].x, blocks.motion[i].y};
        blocks.reference_angle[i] = blocks.motion[i].angle;
    }
}
}  // namespace

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

void Simulation::remove_energy(const std::function<void()>& change)
{
    const double stored = stored_energy(model_, state_).total();
    const double changes = state_.ledger.contact_changes;
    change();
    state_.ledger.removed += stored - stored_energy(model_, state_).total() - (state_.ledger.contact_changes - changes);
}

void Simulation::take_away(const std::vector<Index>& blocks)
{
    remove_energy(
        [&]
        {
            for (const Index block : blocks)
                remove_block(block, state_.blocks);
            std::erase_if(state_.next_to_excavation, [&](Index i) { return state_.blocks.present[i] == 0; });
            wake_all(state_.blocks);
            state_.rest_changed = true;
            renew_contacts();
        });
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
    std::vector<std::uint8_t> was_fixed;  // by the user's numbers: blocks may be sorted anew below
    for (const Index slot : model_.slot_of_user)
        was_fixed.push_back(state_.blocks.is_free(slot) ? 0 : 1);
    for (const Index wall : sides.begins)
        was_fixed[model_.user_number[wall]] = 0;  // it touches the rock without force
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
    {
        permute(model_.user_number, was_fixed);
        join_drawn_blocks(model_, was_fixed, state_);
    }
}

void Simulation::change_water()
{
    if (!model_.water.given)
        return;
    const std::vector<Triple> before = state_.water;
    renew_water();
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

void Simulation::begin_stage(Index stage)
{
    const StageDef& def = model_.stages[stage];
    const Index before = state_.stage;
    const BoundaryChange sides = boundary_change(model_, before, stage);
    if (state_.stage_begun)
        set_properties(model_, before);  // to the end, where it was too short for that
    if (state_.stage_begun && def.relax_cycles > 0 && model_.stages[before].relax_to > 0.0)
        keep_released_forces(model_, state_);
    else
        end_released_forces();
    state_.stage = stage;
    state_.stage_begun = true;
    state_.stage_begin_cycle = state_.cycle;
    const Method last_method = state_.method;
    state_.method = def.method.value_or(state_.method);  // before all that asks for the rules of the stage
    state_.damping = def.damping.value_or(state_.damping);
    change_properties();
    ends_.reset();
    forget_stage(def, model_.time_step, state_);
    if (def.relax_cycles > 0)
        release_tractions(model_, before, stage, state_);
    if (state_.contacts_outdated || !def.excavate.empty() || !def.fix.empty() || !def.free.empty() || sides.any())
        remove_energy([&] { change_blocks(def, sides); });
    change_water();
    const bool bolted = install_bolts(model_, state_), lined = install_liners(model_, state_);
    const bool springs_are_empty = begins_with_empty_springs(static_cast<std::size_t>(stage), last_method, state_.method,
                                                             model_.insitu.given);
    if (springs_are_empty && def.relax_cycles > 0)
    {
        std::vector<BlockPush> tensioned;
        pull_bolts(model_, state_, 0.0, tensioned);
        hold_back_loads(model_, tensioned, state_);
    }
    if (bolted || lined)
        runner_.take_contacts();
    start_walls(model_, state_);
    count_ways_anew(state_.blocks);
    statics_.reset();
    state_.statics_due = resolve_rules(model_, state_).tries_statics && can_solve_statics(model_, state_);
    solve_due_statics();
}
}  // namespace hdem
