#include "core/stage/properties.h"

#include "core/boundary/resolve_boundaries.h"
#include "core/joint/all_laws.h"
#include "core/model/factor.h"
#include "core/state/state_hash.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr std::int64_t set_every = 10;  // cycles

double between(double from, double to, double share)
{
    return from + share * (to - from);
}

CoulombSlip between(const CoulombSlip& from, const CoulombSlip& to, double share)
{
    CoulombSlip law = to;
    for (double CoulombSlip::*const value : {&CoulombSlip::normal_stiffness, &CoulombSlip::shear_stiffness,
                                             &CoulombSlip::friction_coefficient, &CoulombSlip::cohesion, &CoulombSlip::restitution})
        law.*value = between(from.*value, to.*value, share);
    return law;
}

/// Find the numbers of a law that follow from others, as 1 / K_S, after these have changed.
void settle(JointRow& row)
{
    if (row.has_memory())
        with_law(row.kind,
                 [&](auto law)
                 {
                     if constexpr (requires { decltype(law)::settle(row.numbers); })
                         decltype(law)::settle(row.numbers);
                 });
}

JointRow between(const JointRow& from, const JointRow& to, double share)
{
    JointRow row = to;
    for (double JointRow::*const value :
         {&JointRow::reach, &JointRow::torn_reach, &JointRow::tension, &JointRow::residual_friction, &JointRow::residual_cohesion})
        row.*value = between(from.*value, to.*value, share);
    for (int i = 0; i < joint_numbers; ++i)
        row.numbers[i] = between(from.numbers[i], to.numbers[i], share);
    settle(row);
    row.is_bonded = from.is_bonded || to.is_bonded;
    return row;
}

void take_joints(const StageLaws& from, JointTable& joints)
{
    std::ranges::copy(from.laws, joints.laws.begin());
    std::ranges::copy(from.rows, joints.rows.begin());
    const auto standard = std::ranges::find(joints.names, "default");
    if (joints.of_walls != no_index && standard != joints.names.end())
        joints.laws[joints.of_walls] = law_of_walls(joints.laws[static_cast<std::size_t>(standard - joints.names.begin())]);
}

void take_densities(const std::vector<double>& densities, Model& model)
{
    for (Index b = 0; b < model.blocks(); ++b)
    {
        const auto material = static_cast<std::size_t>(model.material[b]);
        if (model.is_wall(b) || densities[material] == model.density[material])
            continue;
        const double ratio = densities[material] / model.density[material];
        model.mass[b] *= ratio;
        model.inertia[b] *= ratio;
        model.full_inertia[b] = {1.0 / model.mass[b], 1.0 / model.mass[b], 1.0 / model.inertia[b], 0.0};
    }
    model.density = densities;
}

Factor share_by_table(const StageDef& stage)
{
    return {.rows = stage.set_table, .is_by_time = stage.set_table_by == TableColumn::time};
}

bool differs(const StageLaws& before, const JointTable& now, Index law)
{
    const auto i = static_cast<std::size_t>(law);
    const CoulombSlip &a = before.laws[i], &b = now.laws[i];
    bool different = a.normal_stiffness != b.normal_stiffness || a.shear_stiffness != b.shear_stiffness;
    if (now.has_memory(law))
        for (int k = 0; k < curve_numbers; ++k)
            different = different || before.rows[i].numbers[k] != now.rows[i].numbers[k];
    return different;
}

/// By what the preload grows where the stretch of a point with a memory bears the same stress.
double closure_change(const JointRow& from, const JointRow& to, const PointHistory& point, double length)
{
    const double closure = point.overlap - point.rest_overlap + point.memory.opening;
    if (closure >= 0.0)
        return closure_under(to, normal_state(from, closure).stress) - closure;
    const double stress = point.normal_force / length;
    return closure_under(to, stress) - closure_under(from, stress);
}

void keep_force(const StageLaws& before, const JointTable& now, Contact& contact)
{
    const auto law = static_cast<std::size_t>(contact.law);
    const double ratio = before.laws[law].normal_stiffness / now.laws[law].normal_stiffness;
    const bool has_memory = now.has_memory(contact.law);
    for (PointHistory& point : contact.point)
    {
        if (point.regime == Regime::open)
            continue;
        const double stretch = std::max(point.overlap - point.rest_overlap, 0.0);
        const double change = has_memory ? closure_change(before.rows[law], now.rows[law], point, contact.last_length)
                                         : stretch * (ratio - 1.0);
        point.preload += change;
        point.overlap += change;
        if (!has_memory || !is_spring(static_cast<std::uint8_t>(point.regime)))
            continue;
        const double length = contact.last_length;
        const JointStress held = stress_at_rest(now.rows[law], point.overlap - point.rest_overlap, point.shear_force / length,
                                                point.normal_force / length, point.memory);
        point.energy = length * (held.energy + shear_energy(point.shear_force / length, held.shear_compliance));
        point.stiffness = held.normal_stiffness;
    }
}
}  // namespace

bool needs_preload(const Model& model)
{
    const auto sets_stiffness = [&](const StageLaws& stage)
    {
        for (std::size_t i = 0; i < stage.laws.size(); ++i)
            if (stage.laws[i].normal_stiffness != model.joints.laws[i].normal_stiffness)
                return true;
        return false;
    };
    return model.insitu.given || model.joints.has_memory() || std::ranges::any_of(model.stage_laws, sets_stiffness);
}

bool changes_properties(const Model& model, Index stage)
{
    const auto i = static_cast<std::size_t>(stage);
    return i < model.stage_laws.size() && (!model.stage_laws[i].laws.empty() || !model.stage_densities[i].empty());
}

void set_properties(Model& model, Index stage)
{
    if (!changes_properties(model, stage))
        return;
    if (!model.drawn_hash)
        model.drawn_hash = model_hash(model);
    const auto i = static_cast<std::size_t>(stage);
    take_joints(model.stage_laws[i], model.joints);
    if (!model.stage_densities[i].empty())
        take_densities(model.stage_densities[i], model);
}

void set_joints_between(const StageLaws& before, Index stage, double share, Model& model)
{
    StageLaws laws = model.stage_laws[static_cast<std::size_t>(stage)];
    if (share < 1.0)
    {
        for (std::size_t i = 0; i < laws.laws.size(); ++i)
            laws.laws[i] = between(before.laws[i], laws.laws[i], share);
        for (std::size_t i = 0; i < laws.rows.size(); ++i)
            laws.rows[i] = between(before.rows[i], laws.rows[i], share);
    }
    take_joints(laws, model.joints);
}

bool sets_over_time(const StageDef& stage)
{
    return stage.set_cycles > 0 || !stage.set_table.empty();
}

std::int64_t set_until(const StageDef& stage, double step)
{
    return stage.set_table.empty() ? stage.set_cycles : share_by_table(stage).last_cycle(step);
}

double share_set(const Model& model, const State& state)
{
    const StageDef& stage = model.stages[static_cast<std::size_t>(state.stage)];
    const std::int64_t over = set_until(stage, model.time_step);
    const std::int64_t done = (state.cycle - state.stage_begin_cycle) / set_every * set_every;
    if (state.cycle - state.stage_begin_cycle >= over)
        return 1.0;
    return stage.set_table.empty() ? static_cast<double>(done) / static_cast<double>(over)
                                   : share_by_table(stage).at(done, model.time_step);
}

std::int64_t next_share(const Model& model, const State& state)
{
    const StageDef& stage = model.stages[static_cast<std::size_t>(state.stage)];
    const std::int64_t begin = state.stage_begin_cycle, over = set_until(stage, model.time_step);
    return begin + std::min(over, ((state.cycle - begin) / set_every + 1) * set_every);
}

bool is_setting_joints(const Model& model, const State& state)
{
    const auto stage = static_cast<std::size_t>(state.stage);
    return state.stage_begun && stage < model.stage_laws.size() && !model.stage_laws[stage].laws.empty() &&
           state.cycle < state.stage_begin_cycle + set_until(model.stages[stage], model.time_step);
}

bool keep_forces(const StageLaws& before, const Model& model, State& state)
{
    std::vector<std::uint8_t> changed(model.joints.laws.size(), 0);
    for (Index law = 0; law < static_cast<Index>(changed.size()); ++law)
        changed[static_cast<std::size_t>(law)] = differs(before, model.joints, law) ? 1 : 0;
    if (std::ranges::count(changed, std::uint8_t{1}) == 0)
        return false;
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        Contact contact = state.contacts.get(i);
        if (changed[static_cast<std::size_t>(contact.law)] == 0)
            continue;
        keep_force(before, model.joints, contact);
        state.contacts.put(i, contact);
    }
    return true;
}

void renew_inertia(const Model& model, Blocks& blocks)
{
    for (Index b = 0; b < model.blocks(); ++b)
    {
        BlockInertia& inertia = blocks.inertia[b];
        const BlockInertia& full = model.full_inertia[b];
        for (double BlockInertia::*const value :
             {&BlockInertia::inverse_mass_x, &BlockInertia::inverse_mass_y, &BlockInertia::inverse_inertia})
            inertia.*value = inertia.*value > 0.0 ? full.*value : 0.0;
    }
}

Model model_in_stage(Model model, Index stage)
{
    for (Index i = 0; i <= stage; ++i)
        set_properties(model, i);
    return model;
}
}  // namespace hdem
