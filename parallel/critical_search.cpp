#include "parallel/critical_search.h"

#include "core/geometry/tangent.h"
#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr std::int64_t look_every_cycles = 100;

class ConditionWatch : public Observer
{
  public:
    ConditionWatch(const FailureCondition& condition, const Model& model, const State& state) : condition_(condition)
    {
        for (const Index block : model.slot_of_user)
        {
            start_.push_back(state.blocks.motion[block]);
            named_.push_back(std::ranges::find(condition.blocks, model.name[block]) != condition.blocks.end() ? 1 : 0);
        }
    }

    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return next_multiple(now, look_every_cycles); }

    void observe(const Model& model, const State& state) override
    {
        if (condition_.quantity == FailureCondition::Quantity::detached)
            return count_detached(model, state);
        for (std::size_t user = 0; user < start_.size(); ++user)
        {
            const Index block = model.slot_of_user[user];
            if (named_[user] == 0 &&
                !(condition_.blocks.empty() && state.blocks.is_free(block)))  // free now: stages may free blocks
                continue;
            const double value = value_of(start_[user], state.blocks.motion[block]);
            if (value > result_.greatest || result_.block.empty())
            {
                result_.greatest = value;
                result_.block = model.name[block];
            }
            result_.fails = result_.fails || value > condition_.limit;
        }
    }

    [[nodiscard]] const ConditionResult& result() const { return result_; }

    /// Is it asked for this block? @param user  its number
    [[nodiscard]] bool asks_for(Index user) const { return condition_.blocks.empty() || named_[user] != 0; }

  private:
    void count_detached(const Model& model, const State& state)
    {
        const std::vector<Index> detached = report_displacements(model, state).detached;
        const auto number = static_cast<double>(detached.size());
        if (number > result_.greatest)
        {
            result_.greatest = number;
            result_.block = model.name[detached.front()];
        }
        result_.fails = result_.fails || number > condition_.limit;
    }

    [[nodiscard]] double value_of(const BlockMotion& from, const BlockMotion& to) const
    {
        if (condition_.quantity == FailureCondition::Quantity::rotation)
            return std::abs(to.angle - from.angle) / radians(1.0);
        const double x = to.x - from.x, y = to.y - from.y;
        return std::sqrt(x * x + y * y);
    }

    const FailureCondition& condition_;
    std::vector<BlockMotion> start_;   ///< by the user's number
    std::vector<std::uint8_t> named_;  ///< likewise
    ConditionResult result_;
};

class ConditionKeeper : public Keeper
{
  public:
    ConditionKeeper(const ConditionWatch& watch, const std::stop_token& stop) : watch_(watch), stop_(stop) {}
    [[nodiscard]] std::int64_t next_cycle(std::int64_t) const override { return never; }
    [[nodiscard]] bool keep(const Simulation&) override { return !watch_.result().fails && !stop_.stop_requested(); }
    [[nodiscard]] bool is_to_stop() override { return stop_.stop_requested(); }

  private:
    const ConditionWatch& watch_;
    const std::stop_token& stop_;
};
}  // namespace

ConditionResult run_to_condition(Simulation& simulation, const FailureCondition& condition, const std::stop_token& stop)
{
    ConditionWatch watch(condition, simulation.model(), simulation.state());
    ConditionKeeper keeper(watch, stop);
    Observer* const observers[] = {&watch};
    const std::vector<StageResult> stages = run_stages(simulation, observers, &keeper);
    ConditionResult result = watch.result();
    result.met_ends = result.fails || std::ranges::all_of(stages, &StageResult::met_end);
    const auto is_one_in_question = [&](const std::vector<Index>& users)
    { return std::ranges::any_of(users, [&](Index user) { return watch.asks_for(user); }); };
    const StageResult& last = stages.back();
    const bool ends_otherwise = !result.fails && last.met_end() && !last.at_rest;
    const bool moves = ends_otherwise && is_one_in_question(blocks_not_at_rest(simulation));
    result.ends_moving = moves && !last.sought_rest;
    result.still_moves = moves && last.sought_rest;
    for (const StageResult& stage : stages)
        result.still_moves = result.still_moves || (!result.fails && !stage.met_end() && is_one_in_question(stage.not_at_rest));
    result.cycles = simulation.state().cycle;
    result.was_stopped = stop.stop_requested() && !result.fails;
    return result;
}

Bracket search_between(const CriticalRange& range, double tolerance, int threads, const StandsAt& stands, const AfterPair& after)
{
    const double sign = range.stands < range.fails ? 1.0 : -1.0;  // else the axis is turned round
    const StandsAt turned = [&](double x, int count, const std::stop_token& stop) { return stands(sign * x, count, stop); };
    const auto back = [&](const Bracket& b)
    {
        const auto one = [&](const std::optional<double>& x) { return x ? std::optional(sign * *x) : x; };
        return Bracket{one(b.stands), one(b.fails)};
    };
    const AfterPair after_turned = [&](const Bracket& b)
    {
        if (after)
            after(back(b));
    };
    return back(search_bracket({.tolerance = tolerance, .known = {sign * range.stands, sign * range.fails}}, threads, turned,
                               after_turned));
}
}  // namespace hdem
