#include "tools/python/changed_case.h"

#include "core/model/block_order.h"
#include "io/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace hdem
{
namespace
{
[[noreturn]] void refuse(const std::string& text)
{
    throw InputError(Problem{.key = {}, .text = text});
}

bool has_same_blocks(const Model& a, const Model& b)
{
    return a.blocks() == b.blocks() && a.name == b.name && a.area == b.area && a.origin == b.origin &&
           std::ranges::equal(a.shapes.vertex, b.shapes.vertex) && a.joints.names == b.joints.names &&
           a.joints.has_memory() == b.joints.has_memory() && a.histories.size() == b.histories.size();
}

/// Do contacts that have met since the start differ from drawn ones in a stage?
bool tells_apart(const Model& model, std::size_t joint)
{
    const auto met = static_cast<std::size_t>(model.joints.unbonded_of(static_cast<Index>(joint)));
    return std::ranges::any_of(model.stage_laws,
                               [&](const StageLaws& stage)
                               {
                                   return !stage.laws.empty() &&
                                          (stage.laws[joint].cohesion != stage.laws[met].cohesion ||
                                           stage.laws[joint].friction_coefficient != stage.laws[met].friction_coefficient);
                               });
}

/// For each law of `from` the number that it has in `to`: where a stage changes joints, contacts that meet later have a law of their own.
std::vector<Index> numbers_of_laws(const Model& from, const Model& to)
{
    const JointTable &before = from.joints, &now = to.joints;
    std::vector<Index> number(before.laws.size(), 0);
    if (before.of_walls != no_index)
        number[static_cast<std::size_t>(before.of_walls)] = now.of_walls;
    for (std::size_t j = 0; j < before.names.size(); ++j)
    {
        const auto drawn = static_cast<Index>(j), met = before.unbonded_of(drawn);
        if (met == drawn && now.unbonded_of(drawn) != drawn && tells_apart(to, j))
            refuse(
                fmt::format("joint \"{}\": cohesion = 0 Pa in the case (the run does not remember which of its contacts were drawn "
                            "and which met later, and only the former may get a cohesion now). Begin with a small cohesion, e.g. 1 "
                            "Pa.",
                            printable(before.names[j])));
        number[static_cast<std::size_t>(met)] = now.unbonded_of(drawn);
        number[j] = drawn;
    }
    return number;
}

/// The same contacts with other numbers of laws, and with room for preloads where a stage changes stiffness.
Contacts carried_over(const Contacts& contacts, const std::vector<Index>& law, bool has_preload)
{
    Contacts now;
    now.has_preload = has_preload;
    now.has_memory = contacts.has_memory;
    now.resize(contacts.size());
    for (Index i = 0; i < contacts.size(); ++i)
    {
        Contact contact = contacts.get(i);
        contact.law = law[static_cast<std::size_t>(contact.law)];
        now.put(i, contact);
        now.stale[i] = contacts.stale[i];
    }
    return now;
}
/// Does the case say when something happens in seconds? They are counted as cycles of one step.
bool counts_seconds(const Model& model, const State& state)
{
    const auto stage = static_cast<std::size_t>(state.stage);
    return std::ranges::any_of(model.loads, [](const Load& load) { return load.has_times(); }) ||
           std::ranges::any_of(model.boundaries, [](const Boundary& boundary) { return boundary.factor.is_by_time; }) ||
           std::ranges::any_of(model.stages, [](const StageDef& each)
                               { return !each.set_table.empty() && each.set_table_by == TableColumn::time; }) ||
           (state.stage_begun && stage < model.stages.size() && model.stages[stage].duration);
}

/// The step of a changed model may be smaller.
void take_step(const Model& before, Moment& moment)
{
    auto& [model, state] = moment;
    if (model.has_step || !(model.time_step < before.time_step))
        return;
    if (state.cycle > 0 && counts_seconds(model, state))
        refuse(fmt::format(
            "case: the change makes the step smaller ({:.4g} s, it was {:.4g} s), and the run counts seconds in steps. Give "
            "time.step = {:.4g} from the beginning.",
            model.time_step, before.time_step, model.time_step));
    if (state.default_step > 0.0)
        state.default_step = std::min(state.default_step, model.default_time_step);
    state.blocks.step.next = std::min(state.blocks.step.next, model.time_step);
    if (state.cycle == 0)
        state.blocks.step.last = state.blocks.step.next;
}
}  // namespace

Moment with_other_stages(const Simulation& now, Setup next)
{
    const Model& before = now.model();
    Moment moment{std::move(next.model), now.state()};
    auto& [model, state] = moment;
    if (model.blocks() == before.blocks())
        reorder_blocks(before.user_number, model);
    if (!has_same_blocks(model, before))
        refuse("case: (it has other blocks or joints than the run). Change stages that have not begun, nothing else.");
    const std::size_t begun = static_cast<std::size_t>(state.stage) + (state.stage_begun ? 1 : 0);
    if (model.stages.size() < begun)
        refuse(fmt::format("case: stages = {} (the run is in stage {}). Leave stages that have begun as they are.",
                           model.stages.size(), begun));
    state.contacts = carried_over(state.contacts, numbers_of_laws(before, model),
                                  next.state.contacts.has_preload || state.contacts.has_preload);
    take_step(before, moment);
    return moment;
}
}  // namespace hdem
