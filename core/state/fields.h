#pragma once
/// The fields of each record of the state, listed once.
///
/// A list is a function that gives the members of these names as a tuple of references. It takes the record itself, or the lanes
/// that hold it for four contacts. Whatever handles all fields of a record goes through these lists: Contacts::get and put, sorting,
/// the hash, the checkpoint, the check for finite numbers.
///
/// A new field needs its line in the record and its place in a list; the assertions fail until it is there. core/state/state_tables.h
/// says which arrays of the state hold these records, and which of them decide how a run goes on: those are in state_hash.
///
/// Some fields of the records decide nothing, as each cycle finds them anew before it uses them: `joint_use`, and two of BlockForce that are in no list.
/// Tilt forces and views of contacts are written only in cycles that need them (PassNeeds), but always in the last one of a call: a state that can be looked at has them.

#include "core/state/field_count.h"
#include "core/state/state.h"

#include <tuple>

namespace hdem::fields
{
/// How many fields lists of a record have together.
template <typename Record, typename... Lists>
[[nodiscard]] constexpr std::size_t listed(const Lists&...)
{
    return (std::size_t{0} + ... + std::tuple_size_v<std::invoke_result_t<Lists, Record&>>);
}

/// One list after the other, as one.
template <typename First, typename Second>
constexpr auto joined(const First& first, const Second& second)
{
    return [first, second](auto& record) { return std::tuple_cat(first(record), second(record)); };
}

/// Do it with each field of a list.
template <typename List, typename Record, typename Use>
constexpr void for_each(const List& list, Record&& record, const Use& use)
{
    std::apply([&](auto&... field) { (use(field), ...); }, list(record));
}

/// Do it with each field of a list in two records that have the same names.
template <typename List, typename First, typename Second, typename Use>
constexpr void for_each_pair(const List& list, First&& first, Second&& second, const Use& use)
{
    std::apply([&](auto&... one) { std::apply([&](auto&... other) { (use(one, other), ...); }, list(second)); }, list(first));
}

// Contacts. Contact and Contacts:
inline constexpr auto features = [](auto& c) { return std::tie(c.part_a, c.part_b, c.ref, c.inc, c.ref_edge, c.inc_edge, c.law); };
inline constexpr auto swapped = [](auto& c) { return std::tie(c.swapped); };
// Contact and ContactLanes:
inline constexpr auto lengths = [](auto& c) { return std::tie(c.length_floor, c.last_length); };
inline constexpr auto search = [](auto& c) { return std::tie(c.moved_limit, c.seen[0], c.seen[1], c.seen[2], c.seen[3]); };
// EdgePair and ContactLanes:
inline constexpr auto edges = [](auto& e)
{ return std::tie(e.tx, e.ty, e.start_t, e.start_m, e.length, e.p0x, e.p0y, e.p1x, e.p1y); };
static_assert(listed<EdgePair>(edges) == field_count<EdgePair>());
static_assert(listed<Contact>(features, swapped, lengths, search) - 3 + 2 == field_count<Contact>(),
              "seen is one field with four numbers; edges and point have their own lists");

// Points of contacts. PointHistory; its regime is an array of Contacts:
inline constexpr auto regime = [](auto& p) { return std::tie(p.regime); };
// PointHistory and ContactLanes:
inline constexpr auto forces = [](auto& p)
{ return std::tie(p.normal_force, p.shear_force, p.rest_overlap, p.overlap, p.tilt_force); };
// PointHistory and PreloadLanes:
inline constexpr auto preload = [](auto& p) { return std::tie(p.preload); };
// JointMemory and MemoryLanes::Point:
inline constexpr auto memory = [](auto& m) { return std::tie(m.slip, m.state, m.turn, m.opening, m.broken); };
// PointHistory and MemoryLanes::Point:
inline constexpr auto springs = [](auto& p) { return std::tie(p.energy, p.stiffness); };
static_assert(listed<JointMemory>(memory) == field_count<JointMemory>());
static_assert(listed<PointHistory>(regime, forces, preload, springs) + 1 == field_count<PointHistory>(), "memory has its own list");
static_assert(listed<MemoryLanes::Point>(memory, springs) == field_count<MemoryLanes::Point>());
static_assert(listed<PreloadLanes>(preload) == field_count<PreloadLanes>());
static_assert(listed<ContactLanes>(edges, lengths, search, forces) - 3 == field_count<ContactLanes>(),
              "seen is one field with four numbers");

// Blocks. The arrays that hold one row a block:
inline constexpr auto block_arrays = [](auto& b)
{
    return std::tie(b.motion, b.force, b.inertia, b.stable_step, b.bearing_force, b.margin, b.rest, b.present, b.reference_position,
                    b.reference_angle);
};
static_assert(listed<Blocks>(block_arrays) + 1 == field_count<Blocks>(), "step is no array");
// Their rows:
inline constexpr auto motion = [](auto& m) { return std::tie(m.x, m.y, m.c, m.s, m.vx, m.vy, m.w, m.angle); };
inline constexpr auto force = [](auto& f) { return std::tie(f.x, f.y, f.moment); };
inline constexpr auto reserve = [](auto& f) { return std::tie(f.reserve); };
inline constexpr auto joint_use = [](auto& f) { return std::tie(f.mobilised, f.t_x, f.t_y); };
inline constexpr auto contact_kinds = [](auto& f) { return std::tie(f.contacts); };
inline constexpr auto inertia = [](auto& i) { return std::tie(i.inverse_mass_x, i.inverse_mass_y, i.inverse_inertia); };
inline constexpr auto place = [](auto& v) { return std::tie(v.x(), v.y()); };
inline constexpr auto number = [](auto& value) { return std::tie(value); };
static_assert(listed<BlockMotion>(motion) == field_count<BlockMotion>());
static_assert(listed<BlockForce>(force, reserve, joint_use, contact_kinds) + 2 == field_count<BlockForce>(),
              "joint_load and least_load are scratch");
static_assert(listed<BlockInertia>(inertia) + 1 == field_count<BlockInertia>(), "unused holds nothing");

// What else acts on blocks. ReleasedForce:
inline constexpr auto released_block = [](auto& f) { return std::tie(f.block); };
inline constexpr auto released_force = [](auto& f) { return std::tie(f.x, f.y, f.moment); };
// MovingBlock:
inline constexpr auto moving_block = [](auto& m) { return std::tie(m.block, m.how); };
inline constexpr auto moving_along = [](auto& m) { return std::tie(m.t_x, m.t_y); };
// CreepingBlock:
inline constexpr auto creeping_block = [](auto& b) { return std::tie(b.block, b.looks); };
inline constexpr auto creeping_way = [](auto& b) { return std::tie(b.x, b.y, b.turn, b.by_x, b.by_y, b.by_turn); };
// Triple:
inline constexpr auto triple = [](auto& f) { return std::tie(f.x, f.y, f.w); };
// BoltRecord:
inline constexpr auto bolt_status = [](auto& b) { return std::tie(b.status); };
inline constexpr auto bolt_record = [](auto& b)
{ return std::tie(b.force, b.shear_force, b.greatest_force, b.elongation, b.stored, b.spent); };
// LinerRecord:
inline constexpr auto liner_installed = [](auto& l) { return std::tie(l.installed); };
inline constexpr auto liner_counts = [](auto& l) { return std::tie(l.since, l.hinges); };
inline constexpr auto liner_record = [](auto& l)
{ return std::tie(l.thrust, l.moment, l.displacement, l.parted, l.stored, l.spent); };
static_assert(listed<ReleasedForce>(released_block, released_force) == field_count<ReleasedForce>());
static_assert(listed<MovingBlock>(moving_block, moving_along) == field_count<MovingBlock>());
static_assert(listed<CreepingBlock>(creeping_block, creeping_way) == field_count<CreepingBlock>());
static_assert(listed<Triple>(triple) == field_count<Triple>());
static_assert(listed<BoltRecord>(bolt_status, bolt_record) == field_count<BoltRecord>());
static_assert(listed<LinerRecord>(liner_installed, liner_counts, liner_record) == field_count<LinerRecord>());

// What is told of stages. StageOutcome:
inline constexpr auto outcome = [](auto& s) { return std::tie(s.cycles, s.at_rest, s.ended_by); };
inline constexpr auto outcome_values = [](auto& s) { return std::tie(s.value, s.time); };
// EndWatch:
inline constexpr auto watch = [](auto& w) { return std::tie(w.since_cycle, w.joints); };
inline constexpr auto watch_values = [](auto& w) { return std::tie(w.since_time, w.low, w.high, w.axis_x, w.axis_y); };
// StageBlock:
inline constexpr auto block_of_stage = [](auto& b) { return std::tie(b.stage, b.block); };
// StaticSolution:
inline constexpr auto solution = [](auto& s) { return std::tie(s.stage, s.end, s.iterations); };
inline constexpr auto solution_residual = [](auto& s) { return std::tie(s.residual); };
static_assert(listed<StageOutcome>(outcome, outcome_values) == field_count<StageOutcome>());
static_assert(listed<EndWatch>(watch, watch_values) == field_count<EndWatch>());
static_assert(listed<StageBlock>(block_of_stage) == field_count<StageBlock>());
static_assert(listed<StaticSolution>(solution, solution_residual) == field_count<StaticSolution>());
}  // namespace hdem::fields
