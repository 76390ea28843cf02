#include "core/history_sampler.h"

#include "core/check.h"
#include "core/contact/contact_report.h"
#include "core/history_columns.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Append the columns that a quantity stands for, but none twice. False when the name is not known.
template <class Known, class Value>
bool select(const std::vector<Known>& all, const std::string& quantity, std::vector<Column>& columns, std::vector<Value>& values)
{
    bool found = false;
    for (const Known& known : all)
    {
        if (known.quantity != quantity && known.column.name != quantity)
            continue;
        found = true;
        const auto same = [&](const Column& column) { return column.name == known.column.name; };
        if (std::any_of(columns.begin(), columns.end(), same))
            continue;
        columns.push_back(known.column);
        values.push_back(known.value);
    }
    return found;
}
}  // namespace

void HistorySampler::select_of_liner(const Model& model, const HistoryDef& def)
{
    const auto at = std::ranges::find(model.support.liners, def.liner, &Liner::name);
    if (at == model.support.liners.end())
        throw InputError(Problem{.key = "history",
                                 .text = "history \"" + def.name + "\": liner \"" + def.liner +
                                         "\" (no such liner). Give the name of a [[liner]]."});
    liner_ = static_cast<Index>(at - model.support.liners.begin());
    for (const std::string& quantity : def.quantities)
        if (!select(known_of_liner(), quantity, columns_, of_liner_))
            throw InputError(Problem{.key = "history",
                                     .text = "history \"" + def.name + "\": quantity \"" + quantity +
                                             "\" (not known for a liner). See [[history]] in io/case_format.md."});
}

void HistorySampler::select_of_bolt(const Model& model, const HistoryDef& def)
{
    const auto at = std::ranges::find(model.support.bolts, def.bolt, &Bolt::name);
    if (at == model.support.bolts.end())
        throw InputError(
            Problem{.key = "history",
                    .text = "history \"" + def.name + "\": bolt \"" + def.bolt +
                            "\" (no such bolt). Give the name of a bolt; those of a pattern are called NAME.1, NAME.2, ..."});
    bolt_ = static_cast<Index>(at - model.support.bolts.begin());
    for (const std::string& quantity : def.quantities)
        if (!select(known_of_bolt(), quantity, columns_, of_bolt_))
            throw InputError(Problem{.key = "history",
                                     .text = "history \"" + def.name + "\": quantity \"" + quantity +
                                             "\" (not known for a bolt). See [[history]] in io/case_format.md."});
}

HistorySampler::HistorySampler(const Model& model, const HistoryDef& def)
    : name_(def.name),
      every_(std::max<std::int64_t>(def.every, 1))
{
    if (!def.bolt.empty())
    {
        select_of_bolt(model, def);
        return;
    }
    if (!def.liner.empty())
    {
        select_of_liner(model, def);
        return;
    }
    const std::string object = "history \"" + def.name + "\": ";
    const auto find = [&](const std::string& block)
    {
        const Index at = model.find_block(block);
        if (at == no_index)
            throw InputError(
                Problem{.key = "history", .text = object + "block \"" + block + "\" (no such block). Give the name of a block."});
        return at;
    };
    const bool pair = def.between.size() == 2;
    if (def.point)
        place_ = *def.point - model.origin;
    else
        first_user_ = model.user_number[find(pair ? def.between[0] : def.block)];
    second_user_ = pair ? model.user_number[find(def.between[1])] : no_index;
    for (const std::string& quantity : def.quantities)
    {
        const bool known = def.point ? select(known_of_point(), quantity, columns_, of_point_)
                           : pair    ? select(known_of_pair(), quantity, columns_, of_pair_)
                                     : select(known_of_block(), quantity, columns_, of_block_);
        if (!known)
            throw InputError(Problem{.key = "history",
                                     .text = object + "quantity \"" + quantity + "\" (not known for " +
                                             (def.point ? "a point"
                                              : pair    ? "contacts"
                                                        : "a block") +
                                             "). See [[history]] in io/case_format.md."});
    }
}

void HistorySampler::find_contacts(const Model& model, const State& state)
{
    const std::vector<Index>& block_of = model.shapes.part_block;
    const auto joins_pair = [&](Index i)
    {
        const Index a = block_of[state.contacts.part_a[i]];
        const Index b = block_of[state.contacts.part_b[i]];
        return (a == first_ && b == second_) || (a == second_ && b == first_);
    };
    if (broad_phase_runs_ == state.broad_phase_runs && std::ranges::all_of(contacts_, joins_pair))  // the order may have changed
        return;
    contacts_.clear();
    first_ = model.slot_of_user[first_user_];  // blocks may have been sorted anew
    second_ = second_user_ == no_index ? no_index : model.slot_of_user[second_user_];
    for (Index i = 0; i < state.contacts.size(); ++i)
        if (joins_pair(i))
            contacts_.push_back(i);
    broad_phase_runs_ = state.broad_phase_runs;
}

void HistorySampler::add_memories(const Model& model, const State& state, PairSample& sums) const
{
    double length = 0.0;
    for (const Index i : contacts_)
    {
        const Index law = state.contacts.law[i];
        const bool counts = have_met(model.joints, law) ? is_closed_contact(state, i) : model.joints.has_memory(law);
        if (!counts || state.blocks.present[first_] == 0 || state.blocks.present[second_] == 0)
            continue;
        const ContactReport contact = report_contact(state, i);
        const double half = 0.5 * contact.length;
        for (const JointMemory& point : contact.memory)
        {
            sums.plastic_slip += half * point.slip;
            sums.opening += half * point.opening;
            sums.damage += half * damage_share(model.joints, law, point);
            sums.broken += half * broken_share(model.joints, law, point);
        }
        length += contact.length;
    }
    for (double PairSample::*const mean :
         {&PairSample::plastic_slip, &PairSample::opening, &PairSample::damage, &PairSample::broken})
        sums.*mean = length > 0.0 ? sums.*mean / length : 0.0;
}

PairSample HistorySampler::sample_pair(const Model& model, const State& state)
{
    PairSample sums{.step = state.blocks.step.last};
    add_memories(model, state, sums);
    double longest = -1.0;
    for (const Index i : contacts_)
    {
        if (!is_closed_contact(state, i))
            continue;
        const ContactReport contact = report_contact(state, i);
        sums.normal_force += contact.normal_force;
        sums.shear_force += contact.shear_force;
        sums.tilt_force += contact.tilt_force;
        sums.overlap = std::max(sums.overlap, contact.overlap);
        sums.length += contact.length;
        sums.impulse_points += contact.impulse_points;
        if (contact.length > longest)
            normal_ = contact.first == first_ ? contact.normal : Vec2(-contact.normal);
        longest = std::max(longest, contact.length);
    }
    const BlockMotion& a = state.blocks.motion[first_];
    const BlockMotion& b = state.blocks.motion[second_];
    const Vec2 normal = normal_.isZero() ? Vec2(b.x - a.x, b.y - a.y).normalized() : normal_;
    sums.shear_displacement = -(state.blocks.displacement(second_) - state.blocks.displacement(first_)).dot(turned_left(normal));
    return sums;
}

void HistorySampler::sample(const Model& model, const State& state, std::span<double> values)
{
    HDEM_EXPECT(values.size() == columns_.size());
    for (std::size_t i = 0; i < of_block_.size(); ++i)
        values[i] = of_block_[i](model, state, model.slot_of_user[first_user_]);
    for (std::size_t i = 0; i < of_bolt_.size(); ++i)
        values[i] = of_bolt_[i](model.support.bolts[bolt_], state.support.bolts[bolt_]);
    for (std::size_t i = 0; i < of_liner_.size(); ++i)
        values[i] = of_liner_[i](model.support.liners[liner_], state.support.liners[liner_]);
    for (std::size_t i = 0; i < of_point_.size(); ++i)
        values[i] = of_point_[i](model, state, place_);
    if (of_pair_.empty())
        return;
    find_contacts(model, state);
    const PairSample pair = sample_pair(model, state);
    for (std::size_t i = 0; i < of_pair_.size(); ++i)
        values[i] = of_pair_[i](model, pair);
}
}  // namespace hdem
