#pragma once
/// How many threads cycles run on. The number does not change a result, so it may change at any time.

#include <cstdint>
#include <random>
#include <vector>

namespace hdem
{
/// How many threads a run may use.
struct ThreadRule
{
    enum class Kind : std::uint8_t
    {
        fixed,
        measured,  ///< the number that is fastest now, found again and again
        shuffled   ///< other numbers all the time: for tests
    };
    int most = 1;
    Kind kind = Kind::fixed;
    int first = most;  ///< measured: to begin with
    std::uint32_t seed = 0;

    ThreadRule() = default;
    ThreadRule(int threads) : most(threads), first(threads) {}  ///< fixed
    ThreadRule(int most_of_all, Kind which) : most(most_of_all), kind(which), first(most_of_all) {}

    /// Rule of one of several runs at the same time, which begin with `share` threads each. A fixed number stays; others may grow into what the other runs leave.
    [[nodiscard]] ThreadRule for_share(int share) const
    {
        ThreadRule rule = *this;
        rule.first = share;
        if (is_fixed())
            rule.most = share;
        return rule;
    }
    [[nodiscard]] bool is_fixed() const { return kind == Kind::fixed; }
};

/// Which numbers were used.
struct ThreadUse
{
    struct Change
    {
        std::int64_t cycle = 0;  ///< that ran first with it
        int threads = 1;
    };
    std::vector<std::int64_t> cycles;  ///< by the number of threads; [0] is not used
    std::vector<Change> changes;       ///< the first number and each that was chosen later, without trials; the first thousand
    std::int64_t trials = 0;           ///< of other numbers
};

/// Looks for the number of threads with the least time a cycle, by trying the next lower and the next higher one now and then.
///
/// Time is looked at in windows of some milliseconds. A trial begins with one window; where that is promising it goes on until there are enough of them to
/// compare the means. Trials that fail come at growing intervals, which follow from what the trial has cost: trials take about a hundredth of the time. Cycles
/// that suddenly take much longer, or shorter, are a reason to look at once: other work may have begun on the machine, or ended. Then, and in the beginning,
/// all lower numbers have their window, and the best of them is tried.
///
/// It reads no clock: the caller tells it what cycles took.
/// @see verification/unit/parallel/thread_choice_test.cpp
class ThreadChoice
{
  public:
    explicit ThreadChoice(const ThreadRule& rule);

    /// No more than so many in the cycles that follow: the model has work for no more.
    void limit(int useful);
    /// Number of threads for the next cycles.
    [[nodiscard]] int threads() const { return present_; }
    /// How many cycles to run before took() is told of them.
    [[nodiscard]] std::int64_t piece(std::int64_t left) const;
    /// `cycles` up to cycle `end` took so long on threads() threads, without searches for contacts.
    void took(std::int64_t cycles, std::int64_t end, double seconds);

    [[nodiscard]] const ThreadRule& rule() const { return rule_; }
    [[nodiscard]] const ThreadUse& use() const { return use_; }

  private:
    struct Span
    {
        std::int64_t cycles = 0;
        double seconds = 0.0;
        int windows = 0;
        [[nodiscard]] double cost() const { return seconds / static_cast<double>(cycles); }
    };
    struct Direction
    {
        double interval, next;  ///< [s of cycles]
    };
    enum class Phase : std::uint8_t
    {
        steady,
        tasting,  ///< one window for each candidate
        proving   ///< the best of them, until the mean can be trusted
    };

    void close_window();
    void look_steady(double cost);
    void look_at_taste(double cost);
    void look_at_proof();
    void note_sudden_change();
    void start_trial_if_due();
    void taste_next();
    void end_trial(bool takes);
    [[nodiscard]] int lower(int threads) const;
    [[nodiscard]] int higher(int threads) const;

    ThreadRule rule_;
    ThreadUse use_;
    std::minstd_rand random_;
    int limit_ = 1;
    int chosen_ = 1;
    int present_ = 1;
    Phase phase_ = Phase::steady;
    Span window_, odd_;                    ///< odd: windows in a row whose time is far from what was expected
    bool looks_at_all_ = true;             ///< at the next trial of fewer threads
    std::vector<int> candidates_;          ///< to be tasted; the next one is the last
    int best_ = 0;                         ///< candidate
    double best_cost_ = 0.0, lost_ = 0.0;  ///< of the present trial
    Span proof_;
    double cost_ = 0.0;     ///< of a cycle on the chosen number [s]; 0: not yet known
    double elapsed_ = 0.0;  ///< in cycles [s]
    Direction down_{}, up_{};
    double patience_ = 0.0, calm_until_ = 0.0;  ///< no sudden change is answered before [s of cycles]
};
}  // namespace hdem
