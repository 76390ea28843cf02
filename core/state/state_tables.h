#pragma once
/// All numbers of the state: each table with its name in the checkpoint, its array and the list of a row's fields. What saves, loads,
/// hashes and tests a state goes through these functions.
///
/// The checkpoint has them all. state_hash has those that decide how the run goes on: not for_each_counter, for_each_told, for_each_derived and the ledger.
///
/// A table goes to use(As<type in the checkpoint>{}, name, array, list), a single number to use(name, number).

#include "core/state/fields.h"

#include <array>
#include <cstdint>

namespace hdem::tables
{
template <typename T>
struct As
{
    using Stored = T;
};

/// Numbers of the run that decide how it goes on.
template <typename AnyState, typename Use>
void for_each_of_run(AnyState& state, const Use& use)
{
    use("cycle", state.cycle);
    use("time", state.time);
    use("last_step", state.blocks.step.last);
    use("next_step", state.blocks.step.next);
    use("stage", state.stage);
    use("stage_begun", state.stage_begun);
    use("stage_begin_cycle", state.stage_begin_cycle);
    use("default_step", state.default_step);
    use("quiet_since", state.quiet_since);
    use("method", state.method);
    use("damping", state.damping);
    use("excavation_cycle", state.excavation_cycle);
    use("contacts_outdated", state.contacts_outdated);
    use("rest_changed", state.rest_changed);
    use("flies_ahead", state.flies_ahead);
    use("is_calm", state.is_calm);
    use("statics_due", state.statics_due);
    use("statics_taken", state.statics_taken);
    if (!state.water.empty())
        use("water_until", state.water_until);
}

/// Numbers that are only reported at the end.
template <typename AnyState, typename Use>
void for_each_counter(AnyState& state, const Use& use)
{
    use("worst_residual", state.worst_residual.residual);
    use("worst_residual_share", state.worst_residual.share);
    use("worst_residual_cycle", state.worst_residual.cycle);
    use("broad_phase_runs", state.broad_phase_runs);
    use("feature_searches", state.feature_searches);
}
static_assert(field_count<Steps>() == 2 && field_count<WorstResidual>() == 3 && field_count<SupportState>() == 3 &&
                  field_count<State>() == 35,
              "a new member needs its line above, or its list");

/// Memory of the ends of the running stage.
template <typename AnyState, typename Use>
void for_each_of_ends(AnyState& state, const Use& use)
{
    use(As<std::int64_t>{}, "/state/ends", state.ends, fields::watch);
    use(As<double>{}, "/state/ends_values", state.ends, fields::watch_values);
}

/// Results of stages, only reported at the end.
template <typename AnyState, typename Use>
void for_each_told(AnyState& state, const Use& use)
{
    use(As<std::int64_t>{}, "/state/stages_done", state.stages_done, fields::outcome);
    use(As<double>{}, "/state/stages_ended", state.stages_done, fields::outcome_values);
    use(As<std::int32_t>{}, "/state/not_at_rest", state.not_at_rest, fields::block_of_stage);
    use(As<std::int32_t>{}, "/state/statics", state.statics, fields::solution);
    use(As<double>{}, "/state/statics_residual", state.statics, fields::solution_residual);
    use(As<std::int32_t>{}, "/state/came_loose", state.came_loose, fields::block_of_stage);
}

/// One row a block.
template <typename AnyState, typename Use>
void for_each_of_blocks(AnyState& state, const Use& use)
{
    auto& blocks = state.blocks;
    use(As<double>{}, "/blocks/motion", blocks.motion, fields::motion);
    use(As<double>{}, "/blocks/rebuilt_at", state.rebuilt_at, fields::motion);
    use(As<double>{}, "/blocks/force", blocks.force, fields::joined(fields::force, fields::reserve));
    use(As<std::uint8_t>{}, "/blocks/contact_kinds", blocks.force, fields::contact_kinds);
    use(As<double>{}, "/blocks/inverse_inertia", blocks.inertia, fields::inertia);
    use(As<double>{}, "/blocks/stable_step", blocks.stable_step, fields::number);
    use(As<double>{}, "/blocks/bearing_force", blocks.bearing_force, fields::number);
    use(As<double>{}, "/blocks/margin", blocks.margin, fields::number);
    use(As<std::uint8_t>{}, "/blocks/rest", blocks.rest, fields::number);
    use(As<std::uint8_t>{}, "/blocks/present", blocks.present, fields::number);
    use(As<double>{}, "/blocks/reference_position", blocks.reference_position, fields::place);
    use(As<double>{}, "/blocks/reference_angle", blocks.reference_angle, fields::number);
    if (!state.water.empty())
        use(As<double>{}, "/blocks/water", state.water, fields::triple);
}

/// Blocks that move together, or creep.
template <typename AnyState, typename Use>
void for_each_of_groups(AnyState& state, const Use& use)
{
    use(As<std::int32_t>{}, "/blocks/moving", state.moving, fields::moving_block);
    use(As<float>{}, "/blocks/moving_along", state.moving, fields::moving_along);
    use(As<std::int32_t>{}, "/blocks/creeping", state.creeping, fields::creeping_block);
    use(As<double>{}, "/blocks/creeping_way", state.creeping, fields::creeping_way);
}

/// One row a block, of values that each cycle finds anew before it uses them. They are saved because observers of a state read them; the run does not depend on them.
template <typename AnyState, typename Use>
void for_each_derived(AnyState& state, const Use& use)
{
    use(As<float>{}, "/blocks/joint_use", state.blocks.force, fields::joint_use);
}

/// Blocks that excavations have touched, and the forces on them that are still to be removed.
template <typename AnyState, typename Use>
void for_each_of_excavations(AnyState& state, const Use& use)
{
    use(As<std::int32_t>{}, "/blocks/next_to_excavation", state.next_to_excavation, fields::number);
    use(As<std::int32_t>{}, "/blocks/released", state.released, fields::released_block);
    use(As<double>{}, "/blocks/released_force", state.released, fields::released_force);
}

template <typename AnySupport, typename Use>
void for_each_of_support(AnySupport& support, const Use& use)
{
    use(As<std::uint8_t>{}, "/bolts/status", support.bolts, fields::bolt_status);
    use(As<double>{}, "/bolts/record", support.bolts, fields::bolt_record);
    if (!support.liners.empty())
    {
        use(As<std::uint8_t>{}, "/liners/installed", support.liners, fields::liner_installed);
        use(As<std::int64_t>{}, "/liners/counts", support.liners, fields::liner_counts);
        use(As<double>{}, "/liners/record", support.liners, fields::liner_record);
    }
    use(As<double>{}, "/bolts/history", support.history, fields::number);
}

/// A list of both points of a contact, one after the other.
template <typename List>
constexpr auto of_both_points(const List& list)
{
    return [list](auto& contact) { return std::tuple_cat(list(contact.point[0]), list(contact.point[1])); };
}

/// A list of one point of a contact.
template <int k, typename List>
constexpr auto of_point(const List& list)
{
    return [list](auto& contact) { return list(contact.point[k]); };
}

/// Lists of a Contact: use(As<>{}, name, list).
template <typename Use>
void for_each_of_contact(bool has_preload, bool has_memory, const Use& use)
{
    use(As<std::int32_t>{}, "/contacts/features", fields::features);
    use(As<std::uint8_t>{}, "/contacts/swapped", fields::swapped);
    use(As<std::uint8_t>{}, "/contacts/regime", of_both_points(fields::regime));
    use(As<double>{}, "/contacts/edges", [](auto& contact) { return fields::edges(contact.edges); });
    use(As<float>{}, "/contacts/seen", fields::search);
    use(As<double>{}, "/contacts/length", fields::lengths);
    use(As<double>{}, "/contacts/point_0", of_point<0>(fields::forces));
    use(As<double>{}, "/contacts/point_1", of_point<1>(fields::forces));
    if (has_preload)
        use(As<double>{}, "/contacts/preload", of_both_points(fields::preload));
    if (!has_memory)
        return;
    const auto remembered = [](auto& point) { return std::tuple_cat(fields::memory(point.memory), fields::springs(point)); };
    use(As<double>{}, "/contacts/memory_0", of_point<0>(remembered));
    use(As<double>{}, "/contacts/memory_1", of_point<1>(remembered));
}
}  // namespace hdem::tables
