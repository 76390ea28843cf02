#include "core/joint/mobilised_memory.h"
#include "core/model/liner_growth.h"
#include "core/stage/rules.h"
#include "core/state/stage_cycles.h"
#include "parallel/strength_trial.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr std::int64_t check_state_every = 1000;
constexpr std::int64_t most_cycles_of_elastic_state = 1'000'000;

/// Keep a factor at the value that it has in this state.
void hold_factor(Factor& factor, double time_step, const State& state)
{
    if (!factor.varies())
        return;
    const double value = factor.at(cycles_since(factor.since, state), time_step);
    factor = {.rows = {{0.0, value}}};
}

/// Keep an installed lining as it is: it does not change with its age any more.
void hold_liner(Liner& liner, std::int64_t age)
{
    if (age < 0)
        return;
    liner.pressure *= grown_share(liner.pressure_cycles, age);
    liner.pressure_cycles = 0;
    if (!liner.hardening.empty())
        liner.hardening = {{{0.0, hardening_at(liner, age)}}};
}

/// Keep loads and sides that act in this state as they are, and end all other loads. Trials begin the stage anew: otherwise what is counted from its start
/// would begin anew, too.
void hold_loads(Model& model, const State& state)
{
    std::erase_if(model.loads,
                  [&](const Load& load)
                  {
                      const std::int64_t since = cycles_since(load.factor.since, state);
                      return since < 0 || !(load.from <= since && since < load.until);
                  });
    for (Load& load : model.loads)
    {
        load.from = always_from;
        load.until = always_until;
        load.interval = {};
        hold_factor(load.factor, model.time_step, state);
    }
    for (Boundary& boundary : model.boundaries)
        hold_factor(boundary.factor, model.time_step, state);
    for (Liner& liner : model.support.liners)
        hold_liner(liner, cycles_since(liner.stage, state));
}

/// Laws in force in the state's stage.
StageLaws present_laws(const Model& model, Index stage)
{
    StageLaws laws{model.joints.laws, model.joints.rows};
    for (Index i = 0; i <= stage && i < static_cast<Index>(model.stage_laws.size()); ++i)
        if (!model.stage_laws[i].laws.empty())
            laws = model.stage_laws[i];
    return laws;
}

void set_laws(Model& model, Index stage, const StageLaws& laws)
{
    model.joints.laws = laws.laws;
    model.joints.rows = laws.rows;
    model.stage_laws.assign(model.stages.size(), {});
    model.stage_laws[stage] = laws;
}

/// Bolts and linings that are there are not installed once more where the stage begins anew.
void keep_support(Model& model, const State& state)
{
    for (std::size_t i = 0; i < model.support.bolts.size(); ++i)
        if (state.support.bolts[i].status != BoltStatus::planned)
            model.support.bolts[i].stage = no_index;
    for (std::size_t i = 0; i < model.support.liners.size(); ++i)
        if (state.support.liners[i].installed != 0)
            model.support.liners[i].stage = no_index;
}

/// Springs, damping and criteria of a trial.
void set_rules(Model& model, Index stage)
{
    model.stages[stage] = stage_until_rest(model.stages[stage].name);
    const ConvergenceDef standard;
    ConvergenceDef& criteria = model.convergence;
    criteria.criteria = standard.criteria;
    criteria.blocks = ConvergenceBlocks::all;
    criteria.mean_speed = std::min(criteria.mean_speed, standard.mean_speed);
    criteria.unbalanced_force_ratio = std::min(criteria.unbalanced_force_ratio, standard.unbalanced_force_ratio);
    criteria.block_unbalanced_ratio = std::min(criteria.block_unbalanced_ratio, standard.block_unbalanced_ratio);
    model.damping.local = model.damping.local > 0.0 ? model.damping.local : DampingDef{}.local;
    model.has_step = false;  // steps are as long as what moves can bear
}
}  // namespace

Model trial_model(const Moment& start, const StrengthReduction& reduction)
{
    Model model = start.model;
    const Index stage = start.state.stage;
    set_rules(model, stage);
    hold_loads(model, start.state);
    JointTable table = model.joints;
    const StageLaws laws = present_laws(model, stage);
    table.laws = laws.laws;
    table.rows = laws.rows;
    set_laws(model, stage, reduced_laws(table, reduction));
    keep_support(model, start.state);
    if (reduction.bolts)
        weaken_bolts(model.support, reduction.factor);
    if (reduction.stiffness != 1.0)
    {
        model.contact.correction_rate = 0.0;  // see stiffened_state
        for (double* const step : {&model.time_step, &model.default_time_step})
            *step /= std::sqrt(reduction.stiffness);
    }
    return model;
}

State trial_state(const Model& trial_model, State start)
{
    const std::vector<JointRow>& rows = trial_model.stage_laws[start.stage].rows;
    Contacts& contacts = start.contacts;
    if (rows.empty() || !contacts.has_memory)
        return start;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        Contact contact = contacts.get(i);
        if (contact.last_length <= 0.0 || !rows[contact.law].has_memory())
            continue;
        // Both ends slide by the same way: one ahead of the other would be past its peak where the other comes to it.
        const auto& [first, second] = contact.point;
        const double length = 2.0 * contact.last_length, normal = (first.normal_force + second.normal_force) / length;
        const double shear = (first.shear_force + second.shear_force) / length;
        for (PointHistory& point : contact.point)
            point.memory = mobilised_memory(rows[contact.law], normal, shear, point.memory);
        contacts.put(i, contact);
    }
    return start;
}

namespace
{
/// Until the criteria of rest hold.
void bring_to_rest(Simulation& simulation)
{
    const ConvergenceDef& criteria = simulation.model().convergence;
    for (std::int64_t cycles = 0; cycles < most_cycles_of_elastic_state; cycles += criteria.check_every)
    {
        simulation.advance(criteria.check_every);
        if (simulation.check_rest() && cycles >= criteria.least_cycles && simulation.state().released.empty())
            return;
        if (cycles % check_state_every == 0)
        {
            simulation.check_state();
            simulation.hold_lost_blocks();
        }
    }
    throw RunError("factor of safety: the rock does not come to rest even with a thousand times its strength (" +
                   std::to_string(most_cycles_of_elastic_state) +
                   " cycles). There is no state to begin from: look for blocks that nothing holds with hdem plot.");
}

/// With the laws of the case again.
Moment with_laws(const Simulation& simulation, Index stage, const StageLaws& laws)
{
    Moment rest{simulation.model(), simulation.state()};
    set_laws(rest.model, stage, laws);
    return rest;
}
}  // namespace

Moment elastic_state(const Moment& start, const ThreadRule& threads)
{
    const Index stage = start.state.stage;
    Simulation simulation(trial_model(start, {.factor = 1.0 / great_strength}), start.state, threads);
    simulation.begin_stage(stage);
    bring_to_rest(simulation);
    return with_laws(simulation, stage, present_laws(start.model, stage));
}

Moment elastic_stage(const Moment& before, const State& last, const ThreadRule& threads)
{
    const Index stage = static_cast<Index>(before.model.stages.size()) - 1;
    Model model = before.model;
    const StageDef changes = model.stages[stage];
    set_rules(model, stage);
    model.stages[stage].excavate = changes.excavate;
    model.stages[stage].fix = changes.fix;
    model.stages[stage].free = changes.free;
    model.stages[stage].relax_cycles = changes.relax_cycles;
    hold_loads(model, last);
    JointTable table = model.joints;
    const StageLaws laws = present_laws(model, stage);
    table.laws = laws.laws;
    table.rows = laws.rows;
    model.stage_laws.resize(model.stages.size());
    model.stage_laws[stage] = reduced_laws(table, {.factor = 1.0 / great_strength});
    Simulation simulation(std::move(model), before.state, threads);
    simulation.begin_stage(stage);
    bring_to_rest(simulation);
    return with_laws(simulation, stage, laws);
}

Moment stiffened_state(Moment moment, double times)
{
    const Model& model = moment.model;
    Contacts& contacts = moment.state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const CoulombSlip& joint = model.joints.laws[contacts.law[i]];
        const double length = contacts.lane[i / lanes].last_length[i % lanes];
        for (int k = 0; k < 2; ++k)
        {
            const double force = contacts.normal_force(k, i);
            if (force == 0.0 || length <= 0.0)
                continue;
            const double stress = force / length;
            const bool has_memory = model.joints.has_memory(contacts.law[i]);
            const double closure = has_memory ? closure_under(model.joints.rows[contacts.law[i]], stress)
                                              : stress / joint.normal_stiffness;
            const double spared = closure * (1.0 - 1.0 / times);
            if (contacts.has_preload)
                contacts.preload_lane[i / lanes].preload[k][i % lanes] -= spared;
            else
                contacts.rest_overlap(k, i) += spared;
        }
    }
    moment.state.default_step /= std::sqrt(times);
    return moment;
}
}  // namespace hdem
