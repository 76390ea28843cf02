/// Data that cycles need and that stay from one cycle to the next: contacts found anew, the partition of the work, blocks that are left out.

#include "core/boundary/mean_hold.h"
#include "core/boundary/side_forces.h"
#include "core/contact/contact_forces.h"
#include "core/motion/flight.h"
#include "core/motion/loads.h"
#include "core/motion/rest.h"
#include "core/motion/step_check.h"
#include "core/state/contact_order.h"
#include "core/support/installed_support.h"
#include "parallel/cycle.h"
#include "parallel/team.h"

#include <algorithm>

namespace hdem
{
void CycleRunner::renew_contacts(const Model& model, State& state, int threads)
{
    rules_ = find_rules_(model, state);
    samples_.resize(std::max(samples_.size(), static_cast<std::size_t>(threads)));
    with_team(threads,
              [&](const Team& team)
              {
                  const ScopedTime time(samples_of(team).all);
                  renew_contacts(model, state, team);
              });
}

void CycleRunner::renew_contacts(const Model& model, State& state, const Team& team)
{
    StageClock clock(samples_of(team).sampled, 1.0);
    rebuild_.run(model, state, team);
    team.alone(
        [&]
        {
            prepare(model, state);
            prepare_sums(state, team.threads());
        });
    clock.lap(CycleStage::broad);
}

/// Features that are searched anew may bear no more, or again. Where that is so for many contacts, those that bear are brought together.
void CycleRunner::regroup_contacts(const Model& model, State& state, const Team& team)
{
    constexpr Index least_share = 16;
    team.alone(
        [&]
        {
            if (least_share * count_misplaced(state.contacts) < state.contacts.size())
                return;
            group_alike(model.joints, state.contacts);
            prepare(model, state);
            prepare_sums(state, team.threads());
        });
}

bool CycleRunner::is_prepared(const Model& model, const State& state, const StageRules& rules) const
{
    return prepared_ && (model.boundaries.empty() || prepared_stage_ == state.stage) && rules.contact.law == rules_.contact.law &&
           rules.rest.leaves_out == rules_.rest.leaves_out && rules.has_loads == rules_.has_loads &&
           rules.has_support == rules_.has_support && rules.tractions_change == rules_.tractions_change &&
           rules.moves_walls == rules_.moves_walls;
}

void CycleRunner::prepare(const Model& model, const State& state)
{
    const Index blocks = state.blocks.size();
    make_partition(state, rules_.contact.law != ContactLaw::springs, partition_);
    look_at_blocks(model, state, partition_);
    for (ContactPart& part : partition_.contacts)
        part.tally.stale = static_cast<Index>(std::count(state.contacts.stale.begin() + part.range.begin,
                                                         state.contacts.stale.begin() + part.range.end, std::uint8_t{1}));
    has_stiff_contacts_ = false;
    for (ContactPart& part : partition_.contacts)
    {
        part.unstable = no_index;
        part.is_whole = true;
        part.is_woken = false;
        part.stiff.clear();
        part.forget();
        if (rules_.contact.law != ContactLaw::impulses)
        {
            find_stiff_contacts(part.range, model, state.blocks, state.contacts, part.stiff);
            part.answer = greatest_answer(part.range, model, state.contacts);
        }
        has_stiff_contacts_ = has_stiff_contacts_ || !part.stiff.empty();
    }
    list_block_contacts(state.contacts, blocks, work_.block_contacts);
    prepare_forces(model, state);
    std::vector<Index> loaded = loaded_blocks(model);
    for (const ReleasedForce& force : state.released)
        loaded.push_back(force.block);
    std::ranges::sort(loaded);
    for (BlockPart& part : partition_.blocks)
    {
        part.woken.clear();
        part.is_woken = false;
        find_flying(part.range, work_.block_contacts, state.blocks, part.flying);
        std::erase_if(part.flying,
                      [&](Index b)
                      {
                          const auto is_among = [b](const std::vector<Index>& list) { return std::ranges::binary_search(list, b); };
                          return is_among(part.pushed) || is_among(part.bolted) || is_among(loaded);
                      });
    }
    work_.loads.resize(state.contacts.stale.size());
    work_.pseudo.resize(static_cast<std::size_t>(blocks));
    sums_for_ = 0;
    left_out_ = false;
    rest_unknown_ = true;
    has_loads_ = false;
    prepared_ = true;
    prepared_stage_ = state.stage;
    first_evaluation_ = state.cycle;
}

void CycleRunner::prepare_sums(const State& state, int threads)
{
    sums_for_ = threads;
    sums_run_ = state.contacts.size() >= least_for_sums_;
    if (!sums_run_)
        return;
    std::vector<IndexRange> parts, shares;
    for (const ContactPart& part : partition_.contacts)
        parts.push_back(part.range);
    for (int member = 0; member < threads; ++member)
        shares.push_back(Team(member, threads).share(static_cast<Index>(parts.size())));
    static_assert(largest_part <= RunningSums::most_contacts);
    sums_.prepare(parts, shares, state.contacts, work_.block_contacts);
    for (BlockPart& part : partition_.blocks)
        part.summed = sums_.others(part.range);
    part_loads_.resize(static_cast<std::size_t>(threads));
    for (ContactLoads& loads : part_loads_)
        loads.resize(largest_part);
}

void CycleRunner::prepare_forces(const Model& model, const State& state)
{
    const auto blocks = static_cast<std::size_t>(state.blocks.size());
    work_.constant = constant_forces(model, state);
    work_.held = blocks_held_on_average(model, state);
    work_.external = work_.constant;
    work_.bolted.clear();
    work_.external.resize(rules_.has_loads || rules_.has_support ? blocks : work_.constant.size());
    const std::vector<Index> bolted = rules_.has_support ? bolted_blocks(model, state) : std::vector<Index>{};
    const std::vector<Index> pushed = pushed_blocks(model, state);
    for (BlockPart& part : partition_.blocks)
    {
        part.walls.clear();
        for (Index b = part.range.begin; rules_.moves_walls && b < part.range.end; ++b)
            if (model.is_wall(b) && state.blocks.present[b] != 0)
                part.walls.push_back(b);
        part.pushed = {std::ranges::lower_bound(pushed, part.range.begin), std::ranges::lower_bound(pushed, part.range.end)};
        part.bolted = {std::ranges::lower_bound(bolted, part.range.begin), std::ranges::lower_bound(bolted, part.range.end)};
    }
}

/// The parts to which a woken block is new: those of its contacts, and of the blocks on which these act.
void CycleRunner::mark_woken(const Contacts& contacts)
{
    for (const BlockPart& part : partition_.blocks)
        for (const Index block : part.woken)
            for (Index e = work_.block_contacts.begin[block]; e < work_.block_contacts.begin[block + 1]; ++e)
            {
                const Index contact = work_.block_contacts.entry[e] / 2;
                partition_.contacts[contact / largest_part].is_woken = true;
                for (const Index other : {contacts.ref[contact], contacts.inc[contact]})
                    partition_.blocks[other / blocks_a_part].is_woken = true;
            }
}

void CycleRunner::leave_out(const State& state, const Team& team, std::int64_t now)
{
    const bool all = rest_unknown_ || looks_at_rest(now);
    if (!all)
        team.alone([&] { mark_woken(state.contacts); });
    const IndexRange contact_parts = team.share(static_cast<Index>(partition_.contacts.size()));
    const IndexRange block_parts = team.share(static_cast<Index>(partition_.blocks.size()));
    for (Index i = contact_parts.begin; i < contact_parts.end; ++i)
    {
        ContactPart& part = partition_.contacts[i];
        if (!all && !part.is_woken)
            continue;
        find_active_contacts(part.range, state.blocks, state.contacts, part.active);
        part.is_whole = part.active.size() == 1 && part.active[0].size() == part.range.size();
        part.is_woken = false;
    }
    for (Index i = block_parts.begin; i < block_parts.end; ++i)
    {
        BlockPart& part = partition_.blocks[i];
        if (all || part.is_woken)
            find_active_blocks(part.range, work_.block_contacts, state.contacts, state.blocks, part.active);
        part.is_woken = false;
    }
    team.barrier(
        [&]
        {
            rest_unknown_ = false;
            if (all)
                left_out_ = saves_enough();
        });
}

/// While sums form part by part, to leave out a few contacts saves less than the lists of the others cost (perf/measured.md).
bool CycleRunner::saves_enough() const
{
    constexpr Index least_share = 2;  // the half
    Index all = 0, active = 0;
    for (const ContactPart& part : partition_.contacts)
    {
        all += part.range.size();
        for (const IndexRange& range : part.active)
            active += range.size();
    }
    return sums_run_ ? least_share * active < all : active < all;
}
}  // namespace hdem
