#include "parallel/strength_trial.h"

#include "core/motion/equilibrium.h"
#include "core/observer.h"
#include "core/stage/rules.h"
#include "parallel/state_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr std::int64_t look_every_cycles = 20;
constexpr std::int64_t check_state_every = 1000;
constexpr std::int64_t least_creep_cycles = 5000;
constexpr int creep_looks = 6;  ///< at T, 2 T, ... 32 T
constexpr std::int64_t most_cycles_of_elastic_state = 1'000'000;

/// A quarter of the time in which rock that is half a tolerance above its strength moves by `way`, held back by local damping [s].
double creep_time(const Model& model, double way, double tolerance, double factor)
{
    const double g = std::max(model.gravity.norm(), 1.0);
    const double acceleration = (1.0 - model.damping.local) * g * 0.5 * (0.5 * tolerance / factor);
    return 0.25 * std::sqrt(2.0 * way / std::max(acceleration, 1e-12));
}

class TrialRun
{
  public:
    TrialRun(const Moment& start, const TrialRule& rule, int threads)
        : rule_(rule),
          simulation_(trial_model(start, rule.reduction), start.state, threads)
    {
        simulation_.begin_stage(start.state.stage);
        watch_.emplace(rule.failure, simulation_.model(), simulation_.state());
        trial_.factor = rule.reduction.factor;
    }

    Trial run(const std::stop_token& stop)
    {
        const State& state = simulation_.state();
        const std::int64_t begin = state.cycle;
        const double begin_time = state.time;
        while (!has_ended_ && !stop.stop_requested())
        {
            const std::int64_t every = simulation_.model().convergence.check_every;
            simulation_.advance(next_multiple(state.cycle, every) - state.cycle);
            trial_.cycles = state.cycle - begin;
            trial_.time = state.time - begin_time;
            if (state.cycle % look_every_cycles == 0 || every >= look_every_cycles)
                look();
            if (!has_ended_ && simulation_.check_rest() && trial_.cycles >= simulation_.model().convergence.least_cycles)
                come_to_rest();
            if (!has_ended_ && state.cycle % check_state_every == 0)
                simulation_.check_state();
        }
        return trial_;
    }

    [[nodiscard]] const Simulation& simulation() const { return simulation_; }

  private:
    [[nodiscard]] std::string name(Index user) const { return simulation_.model().name[simulation_.model().slot_of_user[user]]; }

    void end(TrialEnd how, const std::string& reason)
    {
        trial_.end = how;
        trial_.reason = reason;
        trial_.displacement = watch_->farthest().moved;
        has_ended_ = true;
    }

    void look()
    {
        const Model& model = simulation_.model();
        std::vector<Index> small;
        Index failed = no_index;
        for (const Index user : watch_->look(model, simulation_.state()))
            if (!watch_->counts(user, model))
                small.push_back(user);
            else if (failed == no_index || ratio(user) > ratio(failed))
                failed = user;
        if (failed != no_index)
            return fail(failed);
        if (!small.empty())
            let_fall(small);
        look_for_creep();
    }

    void look_for_creep()
    {
        const FailureWatch::Farthest& far = watch_->farthest();
        if (far.block == no_index)
            return;
        if (creep_time_ == 0.0 && trial_.cycles >= least_creep_cycles)
            creep_time_ = std::max(trial_.time, creep_time(simulation_.model(), far.limit, rule_.tolerance, trial_.factor));
        if (creep_time_ == 0.0 || trial_.time < creep_time_)
            return;
        creep_time_ *= 2.0;
        if (watch_->find_creeping() != no_index)
            return fail(far.block);
        if (++looks_ == creep_looks)
            end(TrialEnd::undecided, "neither at rest nor failing: block " + name(far.block) + " has moved " +
                                         with_digits("%.3g", far.moved) + " m of " + with_digits("%.3g", far.limit) + " m");
    }

    /// In terms of its limit.
    [[nodiscard]] double ratio(Index user) const
    {
        const Model& model = simulation_.model();
        return rim_displacement(model.slot_of_user[user], model, simulation_.state().blocks) / watch_->limit(user);
    }

    void fail(Index user)
    {
        const Model& model = simulation_.model();
        trial_.failing = blocks_moving_with(user, model, simulation_.state());
        std::erase(trial_.failing, user);
        trial_.failing.insert(trial_.failing.begin(), user);
        const Index block = model.slot_of_user[user];
        end(TrialEnd::failed, "block " + name(user) + " moves at " +
                                  with_digits("%.3g", rim_speed(block, model, simulation_.state().blocks)) + " m/s after " +
                                  with_digits("%.3g", rim_displacement(block, model, simulation_.state().blocks)) + " m");
    }

    void let_fall(const std::vector<Index>& small)
    {
        std::vector<Index> blocks;
        for (const Index user : small)
        {
            blocks.push_back(simulation_.model().slot_of_user[user]);
            trial_.let_fall.push_back(user);
        }
        simulation_.take_away(blocks);
    }

    void come_to_rest()
    {
        const Model& model = simulation_.model();
        static_cast<void>(watch_->look(model, simulation_.state()));
        const FailureWatch::Farthest& far = watch_->farthest();
        if (far.block == no_index || far.moved <= far.limit)
            return end(TrialEnd::stable, "at rest");
        trial_.failing = {far.block};
        end(TrialEnd::failed, "block " + name(far.block) + " moved " + with_digits("%.3g", far.moved) +
                                  " m before it came to rest, more than " + with_digits("%.3g", far.limit) + " m");
    }

    const TrialRule& rule_;
    Simulation simulation_;
    std::optional<FailureWatch> watch_;
    Trial trial_;
    double creep_time_ = 0.0;  ///< of the next look for creep [s]
    int looks_ = 0;
    bool has_ended_ = false;
};

/// Loads that act now go on, others are over.
void hold_loads(std::vector<Load>& loads, std::int64_t cycle)
{
    std::erase_if(loads, [&](const Load& load) { return !(load.from <= cycle && cycle < load.until); });
    for (Load& load : loads)
    {
        load.from = always_from;
        load.until = always_until;
    }
}
}  // namespace

const char* name_of(TrialEnd end)
{
    return end == TrialEnd::stable ? "stable" : (end == TrialEnd::failed ? "failed" : "undecided");
}

namespace
{
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

/// Springs, damping and criteria of a trial.
void set_rules(Model& model, Index stage)
{
    const std::string name = model.stages[stage].name;
    model.stages[stage] = {.name = name,
                           .cycles = {},
                           .duration = {},
                           .until_converged = true,
                           .max_cycles = std::numeric_limits<std::int64_t>::max() / 2,
                           .method = Method::force,
                           .damping = DampingPreset::automatic};
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
    hold_loads(model.loads, start.state.cycle);
    JointTable table = model.joints;
    const StageLaws laws = present_laws(model, stage);
    table.laws = laws.laws;
    table.rows = laws.rows;
    set_laws(model, stage, reduced_laws(table, reduction));
    if (reduction.stiffness != 1.0)
    {
        model.contact.correction_rate = 0.0;  // see stiffened_state
        for (double* const step : {&model.time_step, &model.default_time_step})
            *step /= std::sqrt(reduction.stiffness);
    }
    return model;
}

Trial run_trial(const Moment& start, const TrialRule& rule, int threads, const std::stop_token& stop, std::optional<Moment>* end)
{
    TrialRun run(start, rule, threads);
    Trial trial = run.run(stop);
    if (end != nullptr)
        end->emplace(Moment{run.simulation().model(), run.simulation().state()});
    return trial;
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

Moment elastic_state(const Moment& start, int threads)
{
    const Index stage = start.state.stage;
    Simulation simulation(trial_model(start, {.factor = 1.0 / great_strength}), start.state, threads);
    simulation.begin_stage(stage);
    bring_to_rest(simulation);
    return with_laws(simulation, stage, present_laws(start.model, stage));
}

Moment elastic_stage(const Moment& before, const State& last, int threads)
{
    const Index stage = static_cast<Index>(before.model.stages.size()) - 1;
    Model model = before.model;
    const StageDef changes = model.stages[stage];
    set_rules(model, stage);
    model.stages[stage].excavate = changes.excavate;
    model.stages[stage].fix = changes.fix;
    model.stages[stage].free = changes.free;
    model.stages[stage].relax_cycles = changes.relax_cycles;
    hold_loads(model.loads, last.cycle);
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
