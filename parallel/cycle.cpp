#include "parallel/cycle.h"

#include "core/boundary/mean_hold.h"
#include "core/boundary/servo.h"
#include "core/boundary/side_forces.h"
#include "core/contact/block_forces.h"
#include "core/contact/contact_forces.h"
#include "core/contact/impulse_law.h"
#include "core/detection/contact_tracking.h"
#include "core/motion/flight.h"
#include "core/motion/loads.h"
#include "core/motion/released_forces.h"
#include "core/motion/rest.h"
#include "core/state/block_sorting.h"
#include "core/support/bolt_forces.h"
#include "core/support/liner_forces.h"
#include "parallel/step_update.h"
#include "parallel/team.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Below this many contacts a team loses more by waiting than it gains.
constexpr Index least_contacts_a_thread = 256;
constexpr std::int64_t timed_every = 16;

/// Ask for what the contacts of a part need that comes soon: processors do not see these addresses coming. `sums`: to be added to, or none.
void fetch_ahead(const Partition& partition, Index now, Index end, const Blocks& blocks, BlockForce* sums)
{
    constexpr Index own_ahead = 3;
    if (now + own_ahead < end)
    {
        const char* const part = reinterpret_cast<const char*>(&partition.contacts[now + own_ahead]);
        for (std::size_t b = 0; b < sizeof(ContactPart); b += 64)
            __builtin_prefetch(part + b, 1);
    }
    if (now + 1 == end)
        return;
    const IndexRange next = partition.contacts[now + 1].blocks;
    for (Index i = next.begin; i < next.end; ++i)
        __builtin_prefetch(&blocks.motion[partition.blocks_of_contacts[i]]);
    if (sums != nullptr)
        for (Index i = next.begin; i < next.end; ++i)
            __builtin_prefetch(&sums[partition.blocks_of_contacts[i]], 1);
}
}  // namespace

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

StageSamples& CycleRunner::samples_of(const Team& team)
{
    return samples_[static_cast<std::size_t>(team.member())];
}

std::vector<StageTimes> CycleRunner::stage_times() const
{
    std::vector<StageTimes> times;
    for (const StageSamples& samples : samples_)
        times.push_back(samples.shared_out());
    return times;
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
    std::vector<IndexRange> shares;
    for (int member = 0; member < threads; ++member)
    {
        const IndexRange parts = Team(member, threads).share(static_cast<Index>(partition_.contacts.size()));
        const Index begin = shares.empty() ? 0 : shares.back().end;
        shares.push_back({begin, parts.begin < parts.end ? partition_.contacts[parts.end - 1].range.end : begin});
    }
    sums_.prepare(shares, state.blocks.size(), work_.block_contacts);
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

Index CycleRunner::find_unstable_contact() const
{
    for (const ContactPart& part : partition_.contacts)
        if (part.unstable != no_index)
            return part.unstable;
    return no_index;
}

bool CycleRunner::found_deep_overlap() const
{
    return std::ranges::any_of(partition_.contacts, [](const ContactPart& part) { return part.tally.deep > 0; });
}

bool CycleRunner::is_prepared(const Model& model, const State& state, const StageRules& rules) const
{
    return prepared_ && (model.boundaries.empty() || prepared_stage_ == state.stage) && rules.contact.law == rules_.contact.law &&
           rules.rest.leaves_out == rules_.rest.leaves_out && rules.has_loads == rules_.has_loads &&
           rules.has_support == rules_.has_support && rules.tractions_change == rules_.tractions_change &&
           rules.moves_walls == rules_.moves_walls;
}

Index CycleRunner::run(const Model& model, State& state, std::int64_t cycles, int threads)
{
    ThreadChoice fixed{ThreadRule(threads)};
    return run(model, state, cycles, fixed);
}

Index CycleRunner::run(const Model& model, State& state, std::int64_t cycles, ThreadChoice& threads)
{
    const StageRules rules = find_rules_(model, state);
    const bool same = is_prepared(model, state, rules);
    rules_ = rules;
    if (!same)
        prepare(model, state);
    if (!rules_.step.varies)  // loads may end within the stage: then steps are found anew
        std::ranges::fill(state.blocks.stable_step, 0.0);
    threads.limit(static_cast<int>(std::max<Index>(1, state.contacts.size() / least_contacts_a_thread)));
    samples_.resize(std::max(samples_.size(), static_cast<std::size_t>(threads.rule().most)));
    for (ContactPart& part : partition_.contacts)  // whoever has had the state may have changed anything
        part.forget();
    for (BlockPart& part : partition_.blocks)
        part.speed_squared = unknown_speed;
    Way way{margin_used({0, state.blocks.size()}, model, state.blocks, state.rebuilt_at)};
    const std::int64_t end = run_end_ = state.cycle + cycles;
    for (bool goes_on = true; goes_on && state.cycle < end && !state.contacts_outdated;)
    {
        const std::int64_t first = state.cycle;
        const std::int64_t last = first + threads.piece(end - first);
        const StageSamples& samples = samples_.front();
        const Way used = way;
        const double before = samples.in_cycles();
        with_team(threads.threads(),
                  [&](const Team& team)
                  {
                      Way mine = used;
                      const bool stable = run_piece(model, state, first, last, team, mine);
                      if (team.is_first())
                      {
                          goes_on = stable;
                          way = mine;
                      }
                  });
        threads.took(state.cycle - first, state.cycle, samples.in_cycles() - before);
    }
    return find_unstable_contact();
}

bool CycleRunner::run_piece(const Model& model, State& state, std::int64_t first, std::int64_t end, const Team& team, Way& way)
{
    StageSamples& samples = samples_of(team);
    const ScopedTime time(samples.all);
    team.alone(
        [&]
        {
            if (sums_for_ != team.threads())
                prepare_sums(state, team.threads());
        });
    bool stable = true;
    for (std::int64_t now = first; now < end && stable && !state.contacts_outdated; ++now)
    {
        const std::int64_t weight = (now - first) % timed_every == 0 ? std::min(timed_every, end - now) : 0;
        StageClock clock(samples.sampled, static_cast<double>(weight));
        stable = cycle(model, state, team, now, way, clock);
    }
    return stable;
}

bool CycleRunner::cycle(const Model& model, State& state, const Team& team, std::int64_t now, Way& way, StageClock& clock)
{
    bool renewed = false;
    const double most = rules_.step.varies ? 1.0 - flight_share : 1.0;
    if (!(way.since_found <= most))
    {
        team.alone([&] { used_ = margin_used({0, state.blocks.size()}, model, state.blocks, state.rebuilt_at); });
        way.since_found = used_;
        if (!(way.since_found <= most))
        {
            renew_contacts(model, state, team);
            renewed = true;
            clock.skip();
            way.since_found = 0.0;
            // This cycle is finished; then the caller sorts the blocks, which no cycle may do.
            team.alone([&] { state.contacts_outdated = is_order_decayed(model, state); });
        }
    }
    // Where no loads have been found yet all contacts take part.
    if (rules_.rest.leaves_out && now != first_evaluation_ && (state.rest_changed || now == first_evaluation_ + 1))
        leave_out(state, team);
    if (rules_.step.varies)
        update_step(model, rules_.step, state, team, now, renewed, partition_, work_.block_contacts);
    // close_cycle makes the next step the last one: nobody may go on before.
    const bool step_changes = state.blocks.step.last != state.blocks.step.next;
    if (rules_.has_loads || rules_.has_support || rules_.moves_walls || rules_.tractions_change)
        team.alone(
            [&]
            {
                if (rules_.moves_walls)
                    drive_walls(model, work_.block_contacts, state);
                if (rules_.tractions_change)
                    take_tractions(model, state);
                if (rules_.has_support)
                    clear_bolt_forces(work_.bolted, work_.constant, work_.external);
                if (rules_.has_loads)
                    take_loads(model, state);
                if (rules_.has_support)
                {
                    pull_bolts(model, state, work_.bolted);
                    press_liners(model, state, liner_solvers_, work_.bolted);
                    add_bolt_forces(work_.bolted, work_.external);
                }
            });
    clock.lap(CycleStage::update);

    const bool is_last = now + 1 == run_end_ || state.contacts_outdated;
    evaluate(model, state, team, way.in_run, is_last, clock);
    find_fast(model, state, team);
    clock.lap(CycleStage::force);
    team.barrier(
        [&]
        {
            has_loads_ = !sums_run();
            if (sums_run())
                std::swap(state.blocks.force, sums_.sums);
        });
    clock.lap(CycleStage::wait);
    bool goes_on = !has_stiff_contacts_ || find_unstable_contact() == no_index;
    for (const ContactPart& part : partition_.contacts)
        goes_on = goes_on && part.tally.deep == 0;
    if (!goes_on && !is_last)
        store_tilts(state, team);
    Index impulses = 0;
    if (rules_.contact.law != ContactLaw::springs)
        for (const ContactPart& part : partition_.contacts)
            impulses += part.tally.impulses;
    find_groups(state, team);
    if (impulses == 0)
        move(model, state, team, now);
    else
        move_with_impulses(model, state, team, now, impulses, clock);
    clock.lap(CycleStage::update);
    team.barrier();
    clock.lap(CycleStage::wait);

    double farthest = 0.0;
    for (const BlockPart& part : partition_.blocks)
        farthest = max(farthest, part.way);
    way.since_found += farthest;
    way.in_run += farthest;
    if (team.is_first())
        close_cycle(model, state);
    if (rules_.step.varies || rules_.rest.leaves_out || step_changes)
        team.barrier();  // all read the step and who rests
    return goes_on;
}

void CycleRunner::take_tractions(const Model& model, const State& state)
{
    work_.constant.assign(work_.constant.size(), {});
    add_constant_forces(model, state, work_.constant);
    std::ranges::copy(work_.constant, work_.external.begin());
}

void CycleRunner::take_loads(const Model& model, State& state)
{
    prescribe_motions(model, state);
    clear_released_forces(state, work_.constant, work_.external);
    apply_loads(model, state, work_.constant, work_.external, work_.loaded);
    apply_released_forces(model, state, work_.external, work_.released);
}

void CycleRunner::close_cycle(const Model& model, State& state)
{
    bool rest_changed = false;
    for (const BlockPart& part : partition_.blocks)
    {
        state.ledger.add(part.ledger);
        rest_changed = rest_changed || part.rest_changed;
    }
    if (rules_.has_loads)
    {
        add_load_work(model, work_.loaded, state);
        add_released_work(model, work_.released, state);
    }
    if (rules_.has_support)
        add_bolt_work(work_.bolted, state.blocks, state.ledger);
    ++state.cycle;
    Steps& step = state.blocks.step;
    state.time += step.next;
    if (step.last != step.next)
        step.last = step.next;
    if (state.rest_changed != rest_changed)
        state.rest_changed = rest_changed;
}

void CycleRunner::leave_out(const State& state, const Team& team)
{
    const IndexRange contact_parts = team.share(static_cast<Index>(partition_.contacts.size()));
    const IndexRange block_parts = team.share(static_cast<Index>(partition_.blocks.size()));
    for (Index i = contact_parts.begin; i < contact_parts.end; ++i)
        find_active_contacts(partition_.contacts[i].range, state.blocks, state.contacts, partition_.contacts[i].active);
    for (Index i = block_parts.begin; i < block_parts.end; ++i)
        find_active_blocks(partition_.blocks[i].range, work_.block_contacts, state.contacts, state.blocks,
                           partition_.blocks[i].active);
    const auto misses = [](const auto& part)
    { return part.active.size() != 1 || part.active[0].begin != part.range.begin || part.active[0].end != part.range.end; };
    team.barrier(
        [&] { left_out_ = std::ranges::any_of(partition_.contacts, misses) || std::ranges::any_of(partition_.blocks, misses); });
}

void CycleRunner::evaluate(const Model& model, State& state, const Team& team, double gone, bool is_last, StageClock& clock)
{
    const bool whole = !has_loads_ || !left_out_;  // each part is evaluated in one pass
    const IndexRange mine = team.share(static_cast<Index>(partition_.contacts.size()));
    for (Index i = mine.begin; i < mine.end; ++i)
    {
        ContactPart& part = partition_.contacts[i];
        fetch_ahead(partition_, i, mine.end, state.blocks, sums_run() ? sums_.sums.data() : nullptr);
        part.ledger = {};
        part.searched = 0;
        if (part.tally.stale > 0)
        {
            clock.lap(CycleStage::force);
            part.searched = refresh_features(part.range, model, state.blocks, state.contacts, part.ledger);
            clock.lap(CycleStage::narrow);
        }
        part.tally = {};
        RegimeRule rule = rules_.contact;
        if (rule.closing != Closing::whole_cycles)
            rule.closing = closing_of(part.answer, state.blocks.step.next);
        const PassNeeds needs{.views = !whole || part.searched > 0 || !(gone <= part.seen_until),
                              .rests = !whole || part.searched > 0 || part.rests,
                              .tilts = is_last || rules_.rest.leaves_out};
        // Eqs. (1)-(10), (24)-(28)
        if (sums_run())
        {
            ContactLoads& loads = part_loads_[team.member()];
            loads.first = part.range.begin;
            sums_.begin(part.range, model, state.blocks.present, work_.external);
            part.tally = evaluate_contacts(part.range, model, rule, state.blocks, state.contacts, loads, part.tally, needs);
            sums_.add(part.range, loads, rules_.damping.needs_joint(), work_.loads);
        }
        else if (!has_loads_)
            part.tally = evaluate_contacts(part.range, model, rule, state.blocks, state.contacts, work_.loads, part.tally, needs);
        else
            for (const IndexRange& range : part.active)
                part.tally = evaluate_contacts(range, model, rule, state.blocks, state.contacts, work_.loads, part.tally, needs);
        part.rests = !whole || part.tally.unrested;
        if (!whole)
            part.forget();
        else if (needs.views)
            part.remember(gone);
        if (!part.stiff.empty())
            part.unstable = find_unstable(model, state.blocks, state.contacts, part.stiff);
        part.ledger.friction += sum(part.tally.friction);
        part.ledger.contact_changes += sum(part.tally.changes);
        part.ledger.dilation += sum(part.tally.dilation);
        part.ledger.bond_breaking += sum(part.tally.broken);
        part.impulses.clear();
        if (part.tally.impulses > 0)
            collect_impulse_points(part.range, model, state.blocks, state.contacts, part.impulses);
    }
}

void CycleRunner::store_tilts(State& state, const Team& team)
{
    const IndexRange mine = team.share(static_cast<Index>(partition_.contacts.size()));
    for (Index i = mine.begin; i < mine.end && !rules_.rest.leaves_out; ++i)
        store_tilt_forces(partition_.contacts[i].range, state.blocks, state.contacts);
}

void CycleRunner::add_up_contacts(State& state)
{
    state.ledger.contact_changes -= state.ledger.coasting;
    state.ledger.coasting = 0.0;
    for (const ContactPart& part : partition_.contacts)
    {
        state.ledger.add(part.ledger);
        state.feature_searches += part.searched;
        contact_point_updates_ += part.tally.closed;
    }
}
}  // namespace hdem
