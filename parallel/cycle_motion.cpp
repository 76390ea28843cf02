/// The second half of a cycle: velocities, impulses, positions.

#include "core/boundary/mean_hold.h"
#include "core/boundary/side_forces.h"
#include "core/contact/block_forces.h"
#include "core/detection/bearing_force.h"
#include "core/motion/creeping_blocks.h"
#include "core/motion/flight.h"
#include "core/motion/integrator.h"
#include "core/motion/rest.h"
#include "core/support/bolt_forces.h"
#include "parallel/cycle.h"
#include "parallel/impulse_sweeps.h"
#include "parallel/team.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// The blocks that all parts list.
std::vector<Index> all_of(const std::vector<BlockPart>& parts, std::vector<Index> BlockPart::*list)
{
    std::vector<Index> blocks;
    for (const BlockPart& part : parts)
        blocks.insert(blocks.end(), (part.*list).begin(), (part.*list).end());
    return blocks;
}

/// So few fast blocks are looked at in each cycle: that takes no time.
constexpr std::size_t few = 128;

/// Does cycle `now` look for groups among all fast blocks, however many there are?
bool looks_among_all(const State& state, std::int64_t now)
{
    return looks_for_groups(now - state.stage_begin_cycle, !state.moving.empty());
}
}  // namespace

void CycleRunner::sum_up_forces(const Model& model, State& state, BlockPart& part)
{
    part.ledger = {};
    part.rest_changed = false;
    part.woken.clear();
    add_work_before(part.pushed, work_.constant, state, part.ledger);
    const auto sum_up = [&](IndexRange range)
    { sum_forces(range, model, work_.block_contacts, work_.loads, work_.external, rules_.damping.needs_joint(), state.blocks); };
    if (!sums_run())
        std::ranges::for_each(part.active, sum_up);  // Eqs. (7), (8)
    else
        for (const Index b : part.summed)  // others have their sums
            sum_up({b, b + 1});
    if (rules_.contact.law != ContactLaw::impulses && notes_bearing_forces(state.cycle - state.stage_begin_cycle))
        for (const IndexRange& range : part.active)
            note_bearing_forces(range, work_.block_contacts, state.contacts, state.blocks);
    for (const Index b : part.bolted)
        state.blocks.rest[b] = 0;
    if (std::isfinite(rules_.groups.loose_distance))
        mark_creeping(part.range, state.creeping, state.blocks);
    if (!state.moving.empty() && std::isfinite(rules_.groups.speed))
        mark_moving(part.range, state.moving, state.blocks);
    if (!part.bolted.empty())
        hold_by_bolts(work_.bolted, part.range, state.blocks);
}

bool CycleRunner::may_have_fast(const BlockPart& part) const
{
    return part.speed_squared > rules_.groups.speed * rules_.groups.speed;
}

void CycleRunner::find_fast(const Model& model, const State& state, const Team& team, std::int64_t now)
{
    if (!std::isfinite(rules_.groups.speed))
        return;
    const bool looks = looks_among_all(state, now);
    std::size_t count = 0;
    const IndexRange mine = team.share(static_cast<Index>(partition_.blocks.size()));
    for (Index i = mine.begin; i < mine.end; ++i)
    {
        BlockPart& part = partition_.blocks[i];
        part.fast.clear();
        if ((looks || count <= few) && may_have_fast(part))  // else only the known groups are looked at
            hdem::find_fast(part.range, model, rules_.groups, state.blocks, part.fast);
        count += part.fast.size();
    }
}

void CycleRunner::find_creeping(const Model& model, State& state, std::int64_t now)
{
    if (!std::isfinite(rules_.groups.loose_distance) || !looks_for_creep(now - state.stage_begin_cycle))
        return;
    watch_creep(model, rules_.groups, state.blocks, all_of(partition_.blocks, &BlockPart::bolted), state.creeping);
}

void CycleRunner::find_groups(const Model& model, State& state, std::int64_t now)
{
    std::size_t count = 0;
    for (const BlockPart& part : partition_.blocks)
        count += part.fast.size();
    const bool among_all = count <= few || looks_among_all(state, now);
    if (!std::isfinite(rules_.groups.speed) || (state.moving.empty() && (count == 0 || !among_all)))
        return;
    std::vector<Index> fast = among_all ? all_of(partition_.blocks, &BlockPart::fast) : std::vector<Index>();
    for (const MovingBlock& known : state.moving)
        if (!among_all && may_have_fast(partition_.blocks[known.block / blocks_a_part]) &&
            may_group(known.block, model, rules_.groups, state.blocks))
            fast.push_back(known.block);
    const ContactTies ties{state.blocks, state.contacts, work_.block_contacts, rules_.groups.speed};
    groups_.find(model, rules_.groups, fast, all_of(partition_.blocks, &BlockPart::bolted), ties, state.moving);
}

void CycleRunner::change_velocities(const Model& model, State& state, std::int64_t now, BlockPart& part)
{
    VelocityWorks works;
    if (rules_.rest.leaves_out)
        for (const IndexRange& range : part.active)
            part.rest_changed = update_rest(range, model, rules_.rest, now, state.blocks, part.ledger, part.woken) ||
                                part.rest_changed;
    for (const IndexRange& range : part.active)
        update_velocities(range, model, rules_.damping, state.blocks, works);  // Eqs. (11)-(14), (20)-(22)
    works.add_to(part.ledger);
    book_walls(part.walls, state.blocks, part.ledger);
}

double CycleRunner::change_positions(const Model& model, State& state, BlockPart& part, std::vector<Triple>* pseudo)
{
    add_work_after(part.pushed, work_.constant, state, part.ledger);
    double way = 0.0;
    part.speed_squared = 0.0;
    for (const IndexRange& range : part.active)
    {
        const Travel travel = update_positions(range, model, state.blocks, pseudo);
        way = std::max(way, travel.way(state.blocks.step.next));
        part.speed_squared = std::max(part.speed_squared, travel.speed_squared);
    }
    if (state.flies_ahead && !part.flying.empty())
    {
        part.speed_squared = unknown_speed;
        way += fly_ahead(part.flying, rules_.step.loose_distance, model, state.blocks, part.ledger);
    }
    return way;
}

void CycleRunner::move(const Model& model, State& state, const Team& team, std::int64_t now)
{
    if (team.is_first())
        add_up_contacts(state);
    const IndexRange mine = team.share(static_cast<Index>(partition_.blocks.size()));
    if (!work_.held.empty())
    {
        for (Index i = mine.begin; i < mine.end; ++i)
            sum_up_forces(model, state, partition_.blocks[i]);
        team.alone([&] { hold_forces(work_.held, model, state.blocks); });
        for (Index i = mine.begin; i < mine.end; ++i)
            change_velocities(model, state, now, partition_.blocks[i]);
        team.alone([&] { hold_velocities(work_.held, model, nullptr, state.blocks, state.ledger); });
        for (Index i = mine.begin; i < mine.end; ++i)
            partition_.blocks[i].way = change_positions(model, state, partition_.blocks[i], nullptr);
        return;
    }
    for (Index i = mine.begin; i < mine.end; ++i)
    {
        BlockPart& part = partition_.blocks[i];
        sum_up_forces(model, state, part);
        change_velocities(model, state, now, part);
        part.way = change_positions(model, state, part, nullptr);
    }
}

void CycleRunner::move_with_impulses(const Model& model, State& state, const Team& team, std::int64_t now, StageClock& clock)
{
    const IndexRange mine = team.share(static_cast<Index>(partition_.blocks.size()));
    for (Index i = mine.begin; i < mine.end; ++i)
    {
        sum_up_forces(model, state, partition_.blocks[i]);
        change_velocities(model, state, now, partition_.blocks[i]);
    }
    clock.lap(CycleStage::update);
    team.barrier();
    clock.lap(CycleStage::wait);
    apply_impulses(model, rules_.islands, state, team, impulses_, partition_, work_);
    clock.lap(CycleStage::impulse);
    if (team.is_first())
        add_up_contacts(state);
    if (!work_.held.empty())  // not before: net forces lack what impulses bear
        team.alone(
            [&]
            {
                hold_velocities(work_.held, model, &work_.pseudo, state.blocks, state.ledger);
                hold_forces(work_.held, model, state.blocks);
            });
    for (Index i = mine.begin; i < mine.end; ++i)
        partition_.blocks[i].way = change_positions(model, state, partition_.blocks[i], &work_.pseudo);
}
}  // namespace hdem
