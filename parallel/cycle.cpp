#include "parallel/cycle.h"

#include "core/boundary/servo.h"
#include "core/boundary/side_forces.h"
#include "core/detection/contact_tracking.h"
#include "core/motion/loads.h"
#include "core/motion/released_forces.h"
#include "core/motion/rest.h"
#include "core/state/block_sorting.h"
#include "core/support/bolt_forces.h"
#include "core/support/liner_damping.h"
#include "parallel/step_update.h"
#include "parallel/team.h"

#include <algorithm>
#include <numbers>

namespace hdem
{
namespace
{
/// Damping of bolts on blocks that have no local damping, in stages that seek rest, as a share of the critical one. Local damping alpha damps a swing as
/// alpha / pi of the critical damping does.
double damping_of_bolts(const DampingRule& rule)
{
    return rule.settling > 0.0 ? rule.local * std::numbers::inv_pi : 0.0;
}

/// Local damping of linings, in stages that seek rest only.
double damping_of_liners(const DampingRule& rule)
{
    return rule.settling > 0.0 ? rule.local : 0.0;
}

/// Below this many contacts a team loses more by waiting than it gains.
constexpr Index least_contacts_a_thread = 256;
constexpr std::int64_t timed_every = 17;  // a prime: looks are made every 4, 16 or 256 cycles, and are to have their share
}  // namespace

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
    forget_stable_steps(rules_.step, state);
    rest_unknown_ = true;
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
        // Not in the first cycle of each call: blocks at rest are looked for in it.
        const std::int64_t weight = now % timed_every == 0 ? timed_every : (now == first_evaluation_ ? 1 : 0);
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
    constexpr std::int64_t regrouped_every = 256;
    if (!renewed && now % regrouped_every == 0)
        regroup_contacts(model, state, team);
    // Where no loads have been found yet all contacts take part.
    if (rules_.rest.leaves_out && now != first_evaluation_ && (state.rest_changed || now == first_evaluation_ + 1))
        leave_out(state, team, now);
    if (rules_.step.varies)
        update_step(model, rules_.step, state, team, now, renewed, partition_, work_.block_contacts);
    if (rules_.has_loads || rules_.has_support || rules_.moves_walls || rules_.tractions_change || rules_.damping.follows_support)
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
                    pull_bolts(model, state, damping_of_bolts(rules_.damping), work_.bolted);
                    press_liners(model, state, liner_solvers_, damping_of_liners(rules_.damping), work_.bolted);
                    add_bolt_forces(work_.bolted, work_.external);
                }
                if (rules_.damping.follows_support)
                    rules_.damping.support = support_motion(model, state);
            });
    clock.lap(CycleStage::update);

    const bool is_last = now + 1 == run_end_ || state.contacts_outdated;
    evaluate(model, state, team, way.in_run, is_last, clock);
    find_fast(model, state, team, now);
    clock.lap(CycleStage::force);
    team.barrier(
        [&]
        {
            close_evaluation(model, state, now);
            clock.lap(CycleStage::update);
        });
    clock.lap(CycleStage::wait);
    if (!goes_on_ && !is_last)
    {
        store_tilts(state, team);
        team.barrier();  // no block moves before
    }
    if (impulses_ == 0)
        move(model, state, team, now);
    else
        move_with_impulses(model, state, team, now, clock);
    clock.lap(CycleStage::update);
    team.barrier(
        [&]
        {
            close_cycle(model, state);
            clock.lap(CycleStage::update);
        });
    clock.lap(CycleStage::wait);
    way.since_found += farthest_;
    way.in_run += farthest_;
    return goes_on_;
}

void CycleRunner::close_evaluation(const Model& model, State& state, std::int64_t now)
{
    has_loads_ = !sums_run();
    if (sums_run())
        std::swap(state.blocks.force, sums_.sums);
    goes_on_ = !has_stiff_contacts_ || find_unstable_contact() == no_index;
    impulses_ = 0;
    for (const ContactPart& part : partition_.contacts)
    {
        goes_on_ = goes_on_ && part.tally.deep == 0;
        impulses_ += part.tally.impulses;
    }
    find_creeping(model, state, now);
    find_groups(model, state, now);
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
    farthest_ = 0.0;
    for (const BlockPart& part : partition_.blocks)
    {
        state.ledger.add(part.ledger);
        rest_changed = rest_changed || part.rest_changed;
        farthest_ = max(farthest_, part.way);
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
}  // namespace hdem
