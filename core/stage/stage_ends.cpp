#include "core/stage/stage_ends.h"

#include "core/check.h"
#include "core/contact/contact_report.h"
#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Spreads the bits of a number, after Steele, Lea and Flood, "Fast splittable pseudorandom number generators" (2014).
std::uint64_t mixed(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// Number of a part that does not change when blocks are sorted anew.
std::uint64_t user_part(const Model& model, Index part)
{
    const Index block = model.shapes.part_block[part];
    return (static_cast<std::uint64_t>(model.user_number[block]) << 20) +
           static_cast<std::uint64_t>(part - model.shapes.part_begin[block]);
}

/// Speed of the second block against the first along the joint, in the middle of the contact [m/s].
double sliding_speed(const Blocks& blocks, const ContactReport& contact)
{
    const Vec2 middle = 0.5 * (contact.point[0] + contact.point[1]);
    const auto velocity = [&](Index block)
    {
        const BlockMotion& m = blocks.motion[block];
        return Vec2(m.vx - m.w * (middle.y() - m.y), m.vy + m.w * (middle.x() - m.x));
    };
    return std::abs((velocity(contact.second) - velocity(contact.first)).dot(contact.shear_axis()));
}

struct JointStates
{
    std::int64_t digest = 0;  ///< of which are closed and broken; the order of the contacts does not matter
    int sliding = 0;          ///< contacts whose blocks slide on each other
};

JointStates joint_states(const Model& model, const State& state)
{
    JointStates states;
    std::uint64_t sum = 0;
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        if (!is_closed_contact(state, i))
            continue;
        std::uint64_t closed = 0, broken = 0;
        bool may_slide = false;
        for (int k = 0; k < 2; ++k)
        {
            const std::uint8_t regime = state.contacts.regime[k][i];
            closed += regime != static_cast<std::uint8_t>(Regime::open) ? 1 : 0;
            may_slide = may_slide || regime >= static_cast<std::uint8_t>(Regime::slip);
            broken += model.joints.has_memory(state.contacts.law[i]) && state.contacts.memory(k, i).broken > 0.0 ? 1 : 0;
        }
        std::uint64_t parts[] = {user_part(model, state.contacts.part_a[i]), user_part(model, state.contacts.part_b[i])};
        std::ranges::sort(parts);
        sum += mixed(mixed(mixed(parts[0]) + parts[1]) + 4 * closed + broken);
        if (may_slide && sliding_speed(state.blocks, report_contact(state, i)) > model.convergence.mean_speed)
            ++states.sliding;
    }
    states.digest = static_cast<std::int64_t>(sum);
    return states;
}

/// The greatest of the blocks that count.
template <typename Value>
double greatest(const std::vector<Index>& users, const Model& model, const State& state, const Value& value)
{
    double found = 0.0;
    if (users.empty())
    {
        for (Index i = 0; i < model.blocks(); ++i)
            if (state.blocks.is_free(i))
                found = std::max(found, value(i));
        return found;
    }
    for (const Index user : users)
        if (const Index i = model.slot_of_user[user]; state.blocks.present[i] != 0)
            found = std::max(found, value(i));
    return found;
}

double unbalanced_ratio(const Model& model, const State& state)
{
    Equilibrium sums;
    add_equilibrium({0, state.blocks.size()}, model, state, ConvergenceBlocks::all, sums);
    return sums.unbalanced_force_ratio();
}

double stage_begin_time(const State& state)
{
    return state.stages_done.empty() ? 0.0 : state.stages_done.back().time;
}

/// A history of one column.
HistorySampler sampler_of(const Model& model, const StageEndDef& def)
{
    const auto found = std::ranges::find(model.histories, def.history, &HistoryDef::name);
    if (found == model.histories.end())
        throw InputError(Problem{.key = "stage",
                                 .text = "stage: until = \"" + def.text + "\" (there is no history \"" + def.history +
                                         "\"). Give the name of a [[history]]."});
    HistoryDef one = *found;
    one.quantities = {def.column};
    return {model, one};
}
}  // namespace

StageEnds::StageEnds(const Model& model, Index stage)
{
    for (const StageEndDef& def : model.stages[static_cast<std::size_t>(stage)].ends)
    {
        End end{.def = def, .blocks = {}, .history = {}};
        for (const std::string& name : def.blocks)
            end.blocks.push_back(model.user_number[model.find_block(name)]);
        if (def.quantity == EndQuantity::history)
            end.history = sampler_of(model, def);
        ends_.push_back(std::move(end));
    }
}

double StageEnds::value_of(End& end, EndWatch& watch, const Model& model, const State& state)
{
    switch (end.def.quantity)
    {
    case EndQuantity::displacement:
        return greatest(end.blocks, model, state, [&](Index i) { return state.blocks.displacement(i).norm(); });
    case EndQuantity::speed:
        return greatest(end.blocks, model, state, [&](Index i) { return state.blocks.velocity(i).norm(); });
    case EndQuantity::unbalanced_force_ratio:
        return unbalanced_ratio(model, state);
    case EndQuantity::time:
        return state.time - stage_begin_time(state);
    case EndQuantity::cycles:
        return static_cast<double>(state.cycle - state.stage_begin_cycle);
    case EndQuantity::history:
    {
        double value = 0.0;
        end.history->set_axis({watch.axis_x, watch.axis_y});
        end.history->sample(model, state, {&value, 1});
        watch.axis_x = end.history->axis().x();
        watch.axis_y = end.history->axis().y();
        return value;
    }
    case EndQuantity::quiet:
    {
        const JointStates now = joint_states(model, state);
        if (now.digest != watch.joints)  // the time of quiet begins anew
            watch.since_cycle = -1;
        watch.joints = now.digest;
        return now.sliding;
    }
    }
    return 0.0;
}

namespace
{
/// Does the test hold, as far as this value says?
bool holds(const StageEndDef& def, double value, EndWatch& watch)
{
    switch (def.test)
    {
    case EndTest::above:
        return value >= def.limit;
    case EndTest::below:
        return value <= def.limit;
    case EndTest::nothing:
        return value == 0.0;
    case EndTest::within:
        break;
    }
    watch.low = watch.since_cycle < 0 ? value : std::min(watch.low, value);
    watch.high = watch.since_cycle < 0 ? value : std::max(watch.high, value);
    return watch.high - watch.low <= def.limit;
}
}  // namespace

std::optional<EndMet> StageEnds::look(const Model& model, State& state, bool is_settled)
{
    std::optional<EndMet> met;
    for (std::size_t i = 0; i < ends_.size(); ++i)
    {
        End& end = ends_[i];
        EndWatch& watch = state.ends[i];
        const double value = value_of(end, watch, model, state);
        const bool counts = is_settled || !end.def.is_settling();
        if (!counts || !holds(end.def, value, watch))
            watch.since_cycle = -1;
        if (!counts || (watch.since_cycle < 0 && !holds(end.def, value, watch)))  // a band begins anew with this value
            continue;
        if (watch.since_cycle < 0)
        {
            watch.since_time = state.time;
            watch.since_cycle = state.cycle;
        }
        if (!met && state.time - watch.since_time >= end.def.for_time && state.cycle - watch.since_cycle >= end.def.for_cycles)
            met = {static_cast<Index>(i), value};
    }
    return met;
}
}  // namespace hdem
