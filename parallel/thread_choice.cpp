#include "parallel/thread_choice.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double window_seconds = 5e-3;
constexpr double proof_seconds = 60e-3;  ///< of a trial that is promising: many turns of the processors among processes
constexpr int proof_windows = 3;         ///< at least, where a window is one long cycle
constexpr double hopeless = 1.1;         ///< times the present cost, in the first window of a trial or in the mean of some
constexpr double far_off = 3.0;          ///< times the least cost: still fewer threads will be slower still
constexpr double worthwhile = 0.98;      ///< times the present cost: then more threads are taken
constexpr double sudden = 1.5;           ///< times the present cost, or a part of it
constexpr int odd_windows = 2;           ///< in a row: not one turn of somebody else
constexpr double newest_share = 0.1;     ///< of a window in the mean cost
constexpr double least_interval = 0.1;   ///< [s]
constexpr double common_interval = 1.0;  ///< [s] to which intervals grow by themselves
constexpr double loss_share = 0.01;      ///< of the time that trials of one direction may lose
constexpr std::size_t most_changes = 1000;
}  // namespace

ThreadChoice::ThreadChoice(const ThreadRule& rule)
    : rule_(rule),
      random_(rule.seed + 1),
      limit_(rule.most),
      chosen_(std::clamp(rule.first, 1, rule.most)),
      present_(chosen_),
      down_{.interval = least_interval, .next = 0.0},
      up_{.interval = least_interval, .next = 0.0},
      patience_(least_interval)
{
    use_.cycles.resize(static_cast<std::size_t>(rule.most) + 1);
}

void ThreadChoice::limit(int useful)
{
    limit_ = std::clamp(useful, 1, rule_.most);
    if (rule_.kind == ThreadRule::Kind::fixed)
        chosen_ = present_ = limit_;
    else if (std::max(chosen_, present_) > limit_)
    {
        phase_ = Phase::steady;
        window_ = odd_ = {};
        cost_ = 0.0;
        chosen_ = present_ = std::min(chosen_, limit_);
    }
}

std::int64_t ThreadChoice::piece(std::int64_t left) const
{
    if (rule_.kind == ThreadRule::Kind::fixed)
        return left;
    if (rule_.kind == ThreadRule::Kind::shuffled)
        return std::min<std::int64_t>(left, 1 + static_cast<std::int64_t>(std::minstd_rand(random_)() % 40));
    const double cost = window_.cycles > 0 ? window_.cost() : cost_;
    if (cost == 0.0)
        return 1;
    return std::clamp<std::int64_t>(std::llround((window_seconds - window_.seconds) / cost), 1, left);
}

void ThreadChoice::took(std::int64_t cycles, std::int64_t end, double seconds)
{
    if (cycles == 0)
        return;
    use_.cycles[static_cast<std::size_t>(present_)] += cycles;
    if (use_.changes.empty() || use_.changes.back().threads != chosen_)
        if (use_.changes.size() < most_changes)
            use_.changes.push_back({.cycle = end - cycles, .threads = chosen_});
    if (rule_.kind == ThreadRule::Kind::shuffled)
        chosen_ = present_ = 1 + static_cast<int>(random_() % static_cast<unsigned>(limit_));
    if (rule_.kind != ThreadRule::Kind::measured || rule_.most == 1)
        return;
    elapsed_ += seconds;
    window_.cycles += cycles;
    window_.seconds += seconds;
    if (window_.seconds >= 0.9 * window_seconds)
        close_window();
}

void ThreadChoice::close_window()
{
    const double cost = window_.cost();
    if (phase_ == Phase::steady)
        look_steady(cost);
    else
    {
        lost_ += window_.seconds - static_cast<double>(window_.cycles) * cost_;
        if (phase_ == Phase::tasting)
            look_at_taste(cost);
        else
            look_at_proof();
    }
    window_ = {};
    if (phase_ == Phase::steady)
        start_trial_if_due();
}

void ThreadChoice::look_steady(double cost)
{
    if (cost_ == 0.0)
    {
        cost_ = cost;
        return;
    }
    if (cost < sudden * cost_ && sudden * cost > cost_)
    {
        odd_ = {};
        cost_ += newest_share * (cost - cost_);
        return;
    }
    odd_.cycles += window_.cycles;
    odd_.seconds += window_.seconds;
    if (++odd_.windows >= odd_windows)
        note_sudden_change();
}

void ThreadChoice::note_sudden_change()
{
    const bool is_slower = odd_.cost() > cost_;
    cost_ = odd_.cost();
    odd_ = {};
    if (elapsed_ < calm_until_)
        return;
    down_.interval = up_.interval = least_interval;
    (is_slower ? down_ : up_).next = elapsed_;
    looks_at_all_ = is_slower;
    patience_ = std::min(2.0 * patience_, 2.0 * common_interval);
    calm_until_ = elapsed_ + patience_;
}

void ThreadChoice::start_trial_if_due()
{
    candidates_.clear();
    if (elapsed_ >= down_.next && chosen_ > 1)
        for (int n = lower(chosen_); n >= 1 && (looks_at_all_ || candidates_.empty()); n = lower(n))
            candidates_.insert(candidates_.begin(), n);
    else if (elapsed_ >= up_.next && chosen_ < limit_)
        candidates_ = {higher(chosen_)};
    if (candidates_.empty())
        return;
    if (candidates_.front() < chosen_)
        looks_at_all_ = false;
    phase_ = Phase::tasting;
    best_ = 0;
    best_cost_ = hopeless * cost_;
    lost_ = 0.0;
    odd_ = {};
    ++use_.trials;
    taste_next();
}

void ThreadChoice::taste_next()
{
    present_ = candidates_.back();
    candidates_.pop_back();
}

void ThreadChoice::look_at_taste(double cost)
{
    if (cost < best_cost_)
    {
        best_ = present_;
        best_cost_ = cost;
    }
    if (!candidates_.empty() && cost < far_off * std::min(best_cost_, cost_))
        return taste_next();
    if (best_ == 0)
        return end_trial(false);
    present_ = best_;
    proof_ = {};
    phase_ = Phase::proving;
}

void ThreadChoice::look_at_proof()
{
    proof_.cycles += window_.cycles;
    proof_.seconds += window_.seconds;
    ++proof_.windows;
    if (proof_.windows < proof_windows)
        return;
    if (proof_.cost() > hopeless * cost_)
        end_trial(false);
    else if (proof_.seconds >= proof_seconds)
        end_trial(proof_.cost() < (present_ < chosen_ ? 1.0 : worthwhile) * cost_);
}

void ThreadChoice::end_trial(bool takes)
{
    const bool is_down = present_ < chosen_;
    Direction& direction = is_down ? down_ : up_;
    phase_ = Phase::steady;
    if (takes)
    {
        Direction& back = is_down ? up_ : down_;
        cost_ = proof_.cost();
        chosen_ = present_;
        direction = {.interval = least_interval, .next = elapsed_};
        back.next = elapsed_ + back.interval;
        return;
    }
    present_ = chosen_;
    direction.interval = std::max(std::min(2.0 * direction.interval, common_interval), lost_ / loss_share);
    direction.next = elapsed_ + direction.interval;
}

/// Next to each other: the numbers up to four, then four and six times powers of two; all that there can be, and all but one, as somebody else may want one.
int ThreadChoice::higher(int threads) const
{
    if (threads >= limit_ - 1)
        return limit_;
    int next = threads + 1;
    if (threads >= 4)
        for (next = 4; next <= threads;)
            next += (next & (next - 1)) == 0 ? next / 2 : next / 3;
    return std::min(next, limit_ - 1);
}

int ThreadChoice::lower(int threads) const
{
    if (threads == limit_ || threads <= 4)
        return threads - 1;
    int last = 4;
    for (int next = 4; next < threads; next += (next & (next - 1)) == 0 ? next / 2 : next / 3)
        last = next;
    return last;
}
}  // namespace hdem
