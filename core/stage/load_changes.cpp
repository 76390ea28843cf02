#include "core/stage/load_changes.h"

#include "core/model/liner_growth.h"
#include "core/stage/properties.h"
#include "core/state/stage_cycles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
/// Cycle of the run from which the cycles of a factor, or of its load, are counted. @pre that stage has begun
std::int64_t zero_of(const Factor& factor, const State& state)
{
    return state.cycle - cycles_since(factor.since, state);
}

std::int64_t later(std::int64_t cycle, std::int64_t by)
{
    return by < std::numeric_limits<std::int64_t>::max() - cycle ? cycle + by : std::numeric_limits<std::int64_t>::max();
}

/// Collects changes of the running stage.
class Changes
{
  public:
    Changes(const Model& model, const State& state) : model_(model), state_(state)
    {
        if (state.stage_begun)
            end_ = last_cycle(model.stages[static_cast<std::size_t>(state.stage)], state.stage_begin_cycle, model.time_step);
    }

    void add(const Load& load)
    {
        if (load.from >= load.until || cycles_since(load.factor.since, state_) < 0)
            return;
        const std::int64_t zero = zero_of(load.factor, state_);
        add(later(zero, load.from), later(zero, load.from));
        add(later(zero, load.until), later(zero, load.until));
        add(load.factor);
    }

    void add(const Factor& factor)
    {
        if (!factor.varies() || cycles_since(factor.since, state_) < 0)
            return;
        const std::int64_t zero = zero_of(factor, state_);
        add(later(zero, factor.first_cycle(model_.time_step)), later(zero, factor.last_cycle(model_.time_step)));
    }

    void add(const Liner& liner)
    {
        const std::int64_t age = cycles_since(liner.stage, state_);
        if (age >= 0)
            add(state_.cycle - age, later(state_.cycle - age, settled_at(liner)));
    }

    /// Those that the stage changes over some cycles.
    void add_joints()
    {
        const auto stage = static_cast<std::size_t>(state_.stage);
        if (state_.stage_begun && stage < model_.stage_laws.size() && !model_.stage_laws[stage].laws.empty())
            add(state_.stage_begin_cycle, state_.stage_begin_cycle + set_until(model_.stages[stage], model_.time_step));
    }

    [[nodiscard]] std::int64_t over_from() const { return over_from_; }

  private:
    void add(std::int64_t first, std::int64_t last)
    {
        if (last > state_.stage_begin_cycle && first < end_)
            over_from_ = std::max(over_from_, later(last, 1));
    }

    const Model& model_;
    const State& state_;
    std::int64_t end_ = std::numeric_limits<std::int64_t>::max();
    std::int64_t over_from_ = 0;
};

/// Is the factor 0, and stays so?
bool has_faded(const Factor& factor, const Model& model, const State& state)
{
    return factor.varies() && factor.rows.back()[1] == 0.0 &&
           cycles_since(factor.since, state) > factor.last_cycle(model.time_step);
}

bool has_static_solution(const State& state)
{
    return std::ranges::any_of(state.statics,
                               [&](const StaticSolution& solution) {
                                   return solution.stage == state.stage &&
                                          (solution.end == StaticEnd::balanced || solution.end == StaticEnd::nearly_balanced);
                               });
}
}  // namespace

std::int64_t last_cycle(const StageDef& stage, std::int64_t begin, double time_step)
{
    if (stage.cycles)
        return begin + *stage.cycles;
    if (stage.duration)
        return begin + static_cast<std::int64_t>(std::ceil(*stage.duration / time_step * (1.0 - 1e-12)));
    return begin + stage.max_cycles;
}

std::int64_t steady_from(const Model& model, const State& state)
{
    Changes changes(model, state);
    for (const Load& load : model.loads)
        changes.add(load);
    for (const Boundary& boundary : model.boundaries)
        if (boundary.acts(state.stage))
            changes.add(boundary.factor);
    for (const Liner& liner : model.support.liners)
        changes.add(liner);
    changes.add_joints();
    return changes.over_from();
}

bool are_times_to_come(const Model& model, const State& state)
{
    const auto is_to_come = [&](const Factor& factor, std::int64_t cycle)
    { return cycles_since(factor.since, state) >= 0 && later(zero_of(factor, state), cycle) >= state.cycle; };
    const auto has_rows_to_come = [&](const Factor& factor)
    { return factor.is_by_time && factor.varies() && is_to_come(factor, factor.last_cycle(model.time_step)); };
    return std::ranges::any_of(model.loads,
                               [&](const Load& load)
                               {
                                   return (load.interval.from_time && is_to_come(load.factor, load.from)) ||
                                          (load.interval.until_time && is_to_come(load.factor, load.until)) ||
                                          has_rows_to_come(load.factor);
                               }) ||
           std::ranges::any_of(model.boundaries, [&](const Boundary& boundary) { return has_rows_to_come(boundary.factor); });
}

std::vector<std::string> changes_to_come(const Model& model, const State& state)
{
    std::vector<std::string> found;
    const auto stage = static_cast<std::size_t>(state.stage);
    const StageDef& def = model.stages[stage];
    const bool is_last = stage + 1 == model.stages.size();
    const auto add = [&](const std::string& what, std::int64_t until)
    {
        if (until > state.cycle)
            found.push_back(what + " until cycle " + std::to_string(until));
    };
    const auto add_factor = [&](const std::string& what, const Factor& factor)
    {
        if (!factor.varies())
            return;
        if (cycles_since(factor.since, state) >= 0)
            add(what + " changes", later(zero_of(factor, state), factor.last_cycle(model.time_step)));
        else if (is_last)
            found.push_back(what + " waits for a stage that has not begun");
    };
    for (std::size_t i = 0; i < model.loads.size(); ++i)
    {
        const Load& load = model.loads[i];
        const std::string name = "load \"" + load.name + "\"";
        if (const std::int64_t since = cycles_since(load.factor.since, state); load.from < load.until && since >= load.until)
            continue;
        else if (since >= 0 && since < load.from)
        {
            if (is_last)
                found.push_back(name + " begins in cycle " + std::to_string(later(zero_of(load.factor, state), load.from)));
        }
        else
        {
            add_factor(name, load.factor);
            const bool ends = load.from < load.until && load.until < std::numeric_limits<std::int64_t>::max();
            const bool seeks_end = !def.cycles && !def.duration;
            if (is_last && seeks_end && ends && since >= 0)
                found.push_back(name + " ends in cycle " + std::to_string(later(zero_of(load.factor, state), load.until)));
        }
    }
    for (const Boundary& boundary : model.boundaries)
        if (boundary.acts(state.stage))
            add_factor("boundary \"" + boundary.name + "\"", boundary.factor);
    for (const Liner& liner : model.support.liners)
        if (const std::int64_t age = cycles_since(liner.stage, state); age >= 0)
        {
            add("liner \"" + liner.name + "\": its weight or pressure grows, or its strength falls,",
                later(state.cycle - age, settled_at(liner)));
            add("liner \"" + liner.name + "\" hardens", later(state.cycle - age, hardened_at(liner)));
        }
    if (stage < model.stage_laws.size() && !model.stage_laws[stage].laws.empty())
        add("set: joints change", state.stage_begin_cycle + set_until(def, model.time_step));
    if (!has_static_solution(state))  // it has taken them off
        add("relax_cycles: forces are taken off", state.stage_begin_cycle + def.relax_cycles);
    return found;
}

std::vector<std::string> motions_that_go_on(const Model& model, const State& state)
{
    std::vector<std::string> found;
    for (const Load& load : model.loads)
    {
        const std::int64_t since = cycles_since(load.factor.since, state);
        const bool acts = since >= load.from && since <= load.until && !has_faded(load.factor, model, state);
        const bool moves = load.velocity_x.value_or(0.0) != 0.0 || load.velocity_y.value_or(0.0) != 0.0 ||
                           load.angular_velocity.value_or(0.0) != 0.0;
        if (acts && moves)
            found.push_back("load \"" + load.name + "\" moves its blocks on");
    }
    for (const Boundary& boundary : model.boundaries)
        if (boundary.acts(state.stage) && boundary.kind == BoundaryKind::velocity && !boundary.velocity.isZero(0.0) &&
            !has_faded(boundary.factor, model, state))
            found.push_back("boundary \"" + boundary.name + "\" moves on");
    if (model.is_driven)
        found.emplace_back("fixed blocks move on with their velocity");
    return found;
}

bool do_tractions_change(const Model& model, const State& state)
{
    Changes changes(model, state);
    for (const Boundary& boundary : model.boundaries)
        if (boundary.acts(state.stage) && boundary.kind == BoundaryKind::stress)
            changes.add(boundary.factor);
    return state.cycle < changes.over_from();
}

bool do_loads_drive(const Model& model, const State& state)
{
    return std::ranges::any_of(model.loads,
                               [&](const Load& load) {
                                   return load.prescribes() && cycles_since(load.factor.since, state) <= load.until &&
                                          !has_faded(load.factor, model, state);
                               });
}

bool do_walls_move(const Model& model, const State& state)
{
    return std::ranges::any_of(model.boundaries,
                               [&](const Boundary& boundary)
                               {
                                   return boundary.acts(state.stage) && moves_walls(boundary.kind) &&
                                          !(boundary.kind == BoundaryKind::velocity && has_faded(boundary.factor, model, state));
                               });
}
}  // namespace hdem
