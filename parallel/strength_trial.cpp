#include "parallel/strength_trial.h"

#include "core/motion/equilibrium.h"
#include "core/observer.h"
#include "parallel/state_check.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr std::int64_t look_every_cycles = 20;
constexpr std::int64_t check_state_every = 1000;
constexpr std::int64_t least_creep_cycles = 5000;
constexpr int creep_looks = 6;  ///< at T, 2 T, ... 32 T

/// A quarter of the time in which rock that is half a tolerance above its strength moves by `way`, held back by local damping [s].
double creep_time(const Model& model, double way, double tolerance, double factor)
{
    const double g = std::max(model.gravity.norm(), 1.0);
    const double acceleration = (1.0 - model.damping.local) * g * 0.5 * (0.5 * tolerance / factor);
    return 0.25 * std::sqrt(2.0 * way / std::max(acceleration, 1e-12));
}

/// The model with the forces of water fixed at those of the start, since F is that of the rock as it stands. Found anew as blocks move, water would push less on
/// blocks that have begun to fail.
Model with_water_as_it_is(Model model)
{
    model.water.given = false;
    return model;
}

Simulation begun(const Moment& start, const StrengthReduction& reduction, const ThreadRule& threads)
{
    Model model = with_water_as_it_is(trial_model(start, reduction));
    State state = trial_state(model, start.state);
    return {std::move(model), std::move(state), threads};
}

class TrialRun
{
  public:
    TrialRun(const Moment& start, const TrialRule& rule, const ThreadRule& threads)
        : rule_(rule),
          simulation_(begun(start, rule.reduction, threads))
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
                                  " m before it came to rest, more than " + with_digits("%.3g", far.limit) +
                                  " m (factor_of_safety.displacement)");
    }

    const TrialRule& rule_;
    Simulation simulation_;
    std::optional<FailureWatch> watch_;
    Trial trial_;
    double creep_time_ = 0.0;  ///< of the next look for creep [s]
    int looks_ = 0;
    bool has_ended_ = false;
};

}  // namespace

const char* name_of(TrialEnd end)
{
    return end == TrialEnd::stable ? "stable" : (end == TrialEnd::failed ? "failed" : "undecided");
}

Trial run_trial(const Moment& start, const TrialRule& rule, const ThreadRule& threads, const std::stop_token& stop,
                std::optional<Moment>* end)
{
    TrialRun run(start, rule, threads);
    Trial trial = run.run(stop);
    if (end != nullptr)
    {
        end->emplace(Moment{run.simulation().model(), run.simulation().state()});
        (*end)->model.water.given = start.model.water.given;
    }
    return trial;
}
}  // namespace hdem
