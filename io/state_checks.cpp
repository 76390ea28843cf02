#include "io/state_checks.h"

#include "core/motion/released_forces.h"
#include "core/motion/rest.h"
#include "core/stage/properties.h"
#include "core/state/contact_order.h"
#include "core/state/fields.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace hdem
{
namespace
{
constexpr std::int64_t longest_run = 1'000'000'000'000'000;  // [cycles]; sums of two such numbers do not overflow

/// All numbers of these lists (core/state/fields.h)?
template <typename Record, typename... Lists>
bool are_finite(const Record& record, const Lists&... lists)
{
    bool all = true;
    const auto look = [&](const auto& number) { all = all && std::isfinite(number); };
    (fields::for_each(lists, record, look), ...);
    return all;
}

/// The same, infinity included.
template <typename Record, typename List>
bool are_numbers(const Record& record, const List& list)
{
    bool all = true;
    fields::for_each(list, record, [&](const auto& number) { all = all && !std::isnan(number); });
    return all;
}

bool is_finite(const BlockMotion& m)
{
    return are_finite(m, fields::motion);
}

/// A unit vector but for round-off.
bool is_rotation(const BlockMotion& m)
{
    return std::abs(m.c * m.c + m.s * m.s - 1.0) < 1e-6;
}

/// Blocks of the model, of stages before `end`, in order?
bool are_blocks_of_stages(const std::vector<StageBlock>& named, Index end, Index blocks)
{
    const bool ascending = std::ranges::adjacent_find(named, std::greater_equal<>()) == named.end();
    return ascending && std::ranges::all_of(named, [&](const StageBlock& b)
                                            { return b.stage >= 0 && b.stage < end && b.block >= 0 && b.block < blocks; });
}

/// What is told of stages.
std::optional<Damage> damage_of_stages(const Model& model, const State& state)
{
    if (!are_blocks_of_stages(state.not_at_rest, state.stage, model.blocks()))
        return Damage{"/state/not_at_rest", "not blocks of stages that are over, ascending"};
    if (!are_blocks_of_stages(state.came_loose, state.stage + 1, model.blocks()))
        return Damage{"/state/came_loose", "not blocks of stages, ascending"};
    Index last = -1;
    for (const StaticSolution& s : state.statics)
    {
        if (s.stage <= last || s.stage > state.stage || s.end > StaticEnd::not_converged || s.iterations < 0)
            return Damage{"/state/statics", "not static solutions of stages, ascending"};
        last = s.stage;
    }
    if (state.ends.size() != model.stages[static_cast<std::size_t>(state.stage)].ends.size())
        return Damage{"/state/ends", "not the ends of the stage"};
    const auto is_watch = [&](const EndWatch& w)
    { return w.since_cycle <= state.cycle && w.since_time <= state.time && are_finite(w, fields::watch_values); };
    if (!std::ranges::all_of(state.ends, is_watch))
        return Damage{"/state/ends", "not what a look leaves behind"};
    for (std::size_t i = 0; i < state.stages_done.size(); ++i)
        if (const StageOutcome& s = state.stages_done[i]; s.ended_by < ended_by::nothing_more ||
                                                          s.ended_by >= static_cast<std::int64_t>(model.stages[i].ends.size()) ||
                                                          !std::isfinite(s.value) || !(s.time >= 0.0 && s.time <= state.time))
            return Damage{"/state/stages_done", "not ends of stages"};
    return std::nullopt;
}

std::optional<Damage> damage_of_run(const Model& model, const State& state)
{
    const auto stages = static_cast<Index>(model.stages.size());
    if (state.stage < 0 || state.stage >= stages || static_cast<Index>(state.stages_done.size()) != state.stage)
        return Damage{"/state@stage", "not a stage of the case"};
    if (!state.stage_begun)
        return Damage{"/state@stage_begun", "no stage has begun"};
    std::int64_t begin = 0;
    for (const StageOutcome& stage : state.stages_done)
    {
        if (stage.cycles < 0 || stage.cycles > state.cycle - begin)
            return Damage{"/state/stages_done", "cycles do not add up"};
        begin += stage.cycles;
    }
    if (state.stage_begin_cycle != begin || state.cycle < begin || state.cycle > longest_run)
        return Damage{"/state@stage_begin_cycle", "cycles do not add up"};
    const auto is_step = [](double step) { return step > 0.0 && std::isfinite(step); };
    if (!is_step(state.blocks.step.last) || !is_step(state.blocks.step.next))
        return Damage{"/state@last_step, next_step", "not a time step"};
    if (!(state.time >= 0.0) || !std::isfinite(state.time) || !(state.quiet_since <= state.time))
        return Damage{"/state@time, quiet_since", "not a time"};
    if (state.method > Method::hybrid || state.damping > DampingPreset::dynamic)
        return Damage{"/state@method", "unknown method or damping"};
    if (state.excavation_cycle < -1 || state.excavation_cycle > state.cycle || state.broad_phase_runs < 1)
        return Damage{"/state", "counters that no run leaves behind"};
    if (auto damage = damage_of_stages(model, state))
        return damage;
    if (!std::ranges::all_of(ledger_terms, [&](const LedgerTerm& term) { return std::isfinite(state.ledger.*term.value); }))
        return Damage{"/state/ledger", "not a finite number"};
    return std::nullopt;
}

/// The block's own inverse mass, or 0 where its motion is prescribed.
bool is_inertia_of(const BlockInertia& inertia, const BlockInertia& full)
{
    const auto fits = [](double value, double own) { return value == 0.0 || value == own; };
    return fits(inertia.inverse_mass_x, full.inverse_mass_x) && fits(inertia.inverse_mass_y, full.inverse_mass_y) &&
           fits(inertia.inverse_inertia, full.inverse_inertia);
}

std::optional<Damage> damage_of_blocks(const Model& model, const State& state)
{
    const Blocks& blocks = state.blocks;
    const auto n = static_cast<std::size_t>(blocks.size());
    const bool densities_change = std::ranges::any_of(model.stage_densities, [](const auto& stage) { return !stage.empty(); });
    const std::vector<BlockInertia> full = densities_change ? model_in_stage(model, state.stage).full_inertia : model.full_inertia;
    if (state.rebuilt_at.size() != n)
        return Damage{"/blocks/rebuilt_at", "not one row for each block"};
    for (std::size_t i = 0; i < n; ++i)
    {
        if (!is_finite(blocks.motion[i]) || !is_rotation(blocks.motion[i]))
            return Damage{"/blocks/motion", "not a place and a rotation"};
        if (!is_finite(state.rebuilt_at[i]) || !is_rotation(state.rebuilt_at[i]))
            return Damage{"/blocks/rebuilt_at", "not a place and a rotation"};
        const BlockForce& f = blocks.force[i];
        if (!are_finite(f, fields::force, fields::joint_use) || std::isnan(f.reserve) ||  // a bolt may never yield
            f.contacts > (contact_force | contact_impulse))
            return Damage{"/blocks/force", "not a force"};
        if (!(blocks.stable_step[i] >= 0.0))
            return Damage{"/blocks/stable_step", "not a time step"};
        if (!(blocks.bearing_force[i] >= 0.0))
            return Damage{"/blocks/bearing_force", "a force below 0"};
        const BlockMotion& m = blocks.motion[i];
        if (!std::isfinite(blocks.margin[i]) || blocks.margin[i] < 0.0)
            return Damage{"/blocks/margin", "not a length"};
        if (blocks.rest[i] > left_out || (blocks.rest[i] >= stopped && (m.vx != 0.0 || m.vy != 0.0 || m.w != 0.0)))
            return Damage{"/blocks/rest", "does not belong to the velocity"};
        if (blocks.present[i] > 1 || !is_inertia_of(blocks.inertia[i], full[i]))
            return Damage{"/blocks/inverse_inertia", "not that of the block"};
        if (!blocks.reference_position[i].allFinite() || !std::isfinite(blocks.reference_angle[i]))
            return Damage{"/blocks/reference_position", "not a finite number"};
    }
    const std::vector<Index>& near = state.next_to_excavation;
    const bool ascending = std::adjacent_find(near.begin(), near.end(), std::greater_equal<>()) == near.end();
    if (!ascending || (!near.empty() && (near.front() < 0 || near.back() >= blocks.size())))
        return Damage{"/blocks/next_to_excavation", "not ascending numbers of blocks"};
    Index last = -1;
    for (const ReleasedForce& f : state.released)
    {
        if (f.block <= last || f.block >= blocks.size())
            return Damage{"/blocks/released", "not ascending numbers of blocks"};
        if (!are_finite(f, fields::released_force))
            return Damage{"/blocks/released_force", "not a force"};
        last = f.block;
    }
    last = -1;
    for (const MovingBlock& m : state.moving)
    {
        if (m.block <= last || m.block >= blocks.size())
            return Damage{"/blocks/moving", "not ascending numbers of blocks"};
        if (m.how > FreeMotion::dragged)
            return Damage{"/blocks/moving", "an unknown motion"};
        if (!are_finite(m, fields::moving_along))
            return Damage{"/blocks/moving_along", "not a direction"};
        last = m.block;
    }
    last = -1;
    for (const CreepingBlock& b : state.creeping)
    {
        if (b.block <= last || b.block >= blocks.size())
            return Damage{"/blocks/creeping", "not ascending numbers of blocks"};
        if (b.looks < 0)
            return Damage{"/blocks/creeping", "a negative number of looks"};
        if (!are_finite(b, fields::creeping_way))
            return Damage{"/blocks/creeping_way", "not a finite number"};
        last = b.block;
    }
    if (state.water.size() != (model.water.given ? blocks.present.size() : 0))
        return Damage{"/blocks/water", "not one force a block"};
    for (const Triple& f : state.water)
        if (!are_finite(f, fields::triple))
            return Damage{"/blocks/water", "not a force"};
    for (const BoltRecord& b : state.support.bolts)
        if (static_cast<std::uint8_t>(b.status) >= bolt_states || !are_finite(b, fields::bolt_record))
            return Damage{"/bolts/record", "not the record of a bolt"};
    for (const LinerRecord& l : state.support.liners)
        if (l.installed > 1 || l.since < 0 || l.since > state.cycle || l.hinges < 0 || !are_finite(l, fields::liner_record))
            return Damage{"/liners/record", "not the record of a liner"};
    if (!std::ranges::all_of(state.support.history, [](double value) { return std::isfinite(value); }))
        return Damage{"/bolts/history", "not a finite number"};
    const bool may_stay = state.stage_begun && model.stages[static_cast<std::size_t>(state.stage)].relax_to > 0.0;
    if (!state.released.empty() && !may_stay && (!state.stage_begun || state.cycle >= released_until(model, state)))
        return Damage{"/blocks/released", "not of the running stage"};
    return std::nullopt;
}

bool is_edge_of(const Shapes& shapes, Index part, Index edge)
{
    return edge >= shapes.vertex_begin[part] && edge < shapes.vertex_begin[part + 1];
}

bool has_features_of_its_parts(const Model& model, const Contact& contact)
{
    const Shapes& shapes = model.shapes;
    const Index ref = contact.swapped ? contact.part_b : contact.part_a;
    const Index inc = contact.swapped ? contact.part_a : contact.part_b;
    return contact.ref == shapes.part_block[ref] && contact.inc == shapes.part_block[inc] && contact.ref != contact.inc &&
           is_edge_of(shapes, ref, contact.ref_edge) && is_edge_of(shapes, inc, contact.inc_edge) && contact.law >= 0 &&
           contact.law < static_cast<Index>(model.joints.laws.size());
}

bool has_finite_numbers(const Contact& contact)
{
    const auto is_finite_point = [](const PointHistory& p)
    {
        return are_finite(p, fields::forces, fields::preload, fields::springs) && are_finite(p.memory, fields::memory) &&
               p.regime <= Regime::impulse;
    };
    return are_finite(contact.edges, fields::edges) && are_finite(contact, fields::lengths) && contact.length_floor > 0.0 &&
           contact.last_length >= 0.0 && are_numbers(contact, fields::search) && is_finite_point(contact.point[0]) &&
           is_finite_point(contact.point[1]);
}

std::optional<Damage> damage_of_contacts(const Model& model, const State& state)
{
    const Index parts = model.shapes.parts();
    std::pair<Index, Index> last{-1, -1};
    for (const Index i : order_by_parts(state.contacts))
    {
        const Contact contact = state.contacts.get(i);
        const std::pair<Index, Index> pair{contact.part_a, contact.part_b};
        if (pair.first < 0 || pair.first >= pair.second || pair.second >= parts || pair <= last)
            return Damage{"/contacts/features", "not pairs of parts, each once"};
        if (!has_features_of_its_parts(model, contact))
            return Damage{"/contacts/features", "not those of its parts"};
        if (state.contacts.stale[i] > 1 || !has_finite_numbers(contact))
            return Damage{"/contacts", "not a finite number, or an unknown regime"};
        last = pair;
    }
    return std::nullopt;
}
}  // namespace

bool is_permutation(const std::vector<Index>& order)
{
    std::vector<bool> seen(order.size(), false);
    for (const Index i : order)
    {
        if (i < 0 || i >= static_cast<Index>(order.size()) || seen[i])
            return false;
        seen[i] = true;
    }
    return true;
}

std::optional<Damage> find_damage(const Model& model, const State& state)
{
    if (auto damage = damage_of_run(model, state))
        return damage;
    if (auto damage = damage_of_blocks(model, state))
        return damage;
    return damage_of_contacts(model, state);
}
}  // namespace hdem
