#include "parallel/thread_choice.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace hdem
{
namespace
{
/// A machine that says what a cycle takes: by the number of threads and the time that has gone by.
class Machine
{
  public:
    using Cost = std::function<double(int threads, double now)>;

    Machine(const ThreadRule& rule, Cost cost) : choice_(rule), cost_(std::move(cost)) {}

    /// Calls of `run`, each of so many cycles, for so long [s].
    void run(double seconds, std::int64_t a_call = 1'000'000)
    {
        const double end = now_ + seconds;
        while (now_ < end)
            for (std::int64_t left = a_call; left > 0 && now_ < end;)
            {
                const std::int64_t piece = choice_.piece(left);
                ASSERT_GE(piece, 1);
                ASSERT_LE(piece, left);
                const double took = static_cast<double>(piece) * cost_(choice_.threads(), now_);
                now_ += took;
                cycles_ += piece;
                left -= piece;
                time_on_.resize(static_cast<std::size_t>(choice_.rule().most) + 1);
                time_on_[static_cast<std::size_t>(choice_.threads())] += took;
                choice_.took(piece, cycles_, took);
            }
    }

    void limit(int useful) { choice_.limit(useful); }
    /// Without trials.
    [[nodiscard]] int chosen() const { return use().changes.back().threads; }
    [[nodiscard]] int threads() const { return choice_.threads(); }
    [[nodiscard]] double now() const { return now_; }
    [[nodiscard]] std::int64_t cycles() const { return cycles_; }
    [[nodiscard]] const ThreadUse& use() const { return choice_.use(); }
    /// Share of the time since the last call of this function on so many threads.
    [[nodiscard]] double share_on(int threads)
    {
        double all = 0.0;
        for (const double seconds : time_on_)
            all += seconds;
        const double share = time_on_[static_cast<std::size_t>(threads)] / all;
        time_on_.assign(time_on_.size(), 0.0);
        return share;
    }

  private:
    ThreadChoice choice_;
    Cost cost_;
    double now_ = 0.0;
    std::int64_t cycles_ = 0;
    std::vector<double> time_on_;
};

ThreadRule measured(int most)
{
    return {most, ThreadRule::Kind::measured};
}

TEST(ThreadChoice, OfAFixedNumberNeverLooks)
{
    Machine machine(4, [](int threads, double) { return 1e-4 * threads; });
    machine.run(1.0);
    EXPECT_EQ(machine.chosen(), 4);
    EXPECT_EQ(machine.use().trials, 0);
    EXPECT_EQ(machine.use().cycles[4], machine.cycles());
}

/// Whatever a cycle takes, from small models to those with a second a cycle: the work of a run alone grows by 3 % at most.
TEST(ThreadChoice, CostsLittleWhereNothingChanges)
{
    for (const double cycle : {5e-6, 1e-4, 5e-3, 0.1})
        for (const double gain : {1.95, 1.3, 1.05, 0.9, 0.3})  // of the second thread
        {
            Machine machine(measured(2), [&](int threads, double) { return threads == 1 ? cycle : cycle / gain; });
            machine.run(5.0 + 200 * cycle);
            const double best = static_cast<double>(machine.cycles()) * cycle / std::max(gain, 1.0);
            EXPECT_LE(machine.now(), 1.03 * best) << cycle << " s a cycle, gain " << gain;
        }
}

TEST(ThreadChoice, FindsTheBestOfMany)
{
    for (const int best : {1, 2, 3, 7, 12, 32, 63, 64})
    {
        Machine machine(measured(64), [&](int threads, double) { return 1e-4 * (1.0 / threads + 1.0 * threads / (best * best)); });
        machine.run(10.0);
        const double cost = 1.0 / machine.threads() + 1.0 * machine.threads() / (best * best);
        EXPECT_LE(cost, 1.1 * 2.0 / best) << "the best are " << best << " threads, chosen " << machine.threads();
    }
}

/// Others want a processor: a team that waits for its slowest member takes three times as long.
TEST(ThreadChoice, LeavesAProcessorThatIsWantedWithinAFifthOfASecond)
{
    Machine machine(measured(2),
                    [](int threads, double now) { return threads == 1             ? 1e-4
                                                         : now > 4.0 && now < 8.0 ? 2e-4
                                                                                  : 0.55e-4; });
    machine.run(4.0);
    EXPECT_EQ(machine.chosen(), 2);
    machine.run(0.2);
    EXPECT_EQ(machine.chosen(), 1);
    static_cast<void>(machine.share_on(1));
    machine.run(3.8);
    EXPECT_GE(machine.share_on(1), 0.97);
    machine.run(1.2);
    EXPECT_EQ(machine.chosen(), 2) << "the processor is free again";
    static_cast<void>(machine.share_on(2));
    machine.run(3.0);
    EXPECT_GE(machine.share_on(2), 0.97);
}

/// Many processors are wanted at once; the next lower numbers are no better.
TEST(ThreadChoice, LooksAtAllLowerNumbersWhereCyclesAreSuddenlySlower)
{
    Machine machine(measured(64), [](int threads, double now) { return 1e-2 / threads * (now > 2.0 && threads > 24 ? 4.0 : 1.0); });
    machine.run(2.0);
    EXPECT_GE(machine.chosen(), 63);
    machine.run(0.4);
    EXPECT_EQ(machine.chosen(), 24);
}

/// A busy neighbour is on the processor in turns of some milliseconds, and lets who has slept go first.
TEST(ThreadChoice, IsNotTakenInByTurns)
{
    std::mt19937 random(3);
    double turn_ends = 0.0, last = 0.0;
    bool has_turn = false;
    Machine machine(measured(2),
                    [&](int threads, double now)
                    {
                        if (threads == 1)
                            return 1e-4;
                        if (now - last > 0.02)  // slept: goes first
                            turn_ends = now + 4e-3, has_turn = true;
                        last = now;
                        for (; turn_ends < now; has_turn = !has_turn)
                            turn_ends += 1e-3 * std::uniform_real_distribution<>(2.0, 6.0)(random);
                        return has_turn ? 0.52e-4 : 4e-4;
                    });
    machine.run(10.0);
    EXPECT_EQ(machine.chosen(), 1);
    EXPECT_LE(machine.now(), 1.05 * static_cast<double>(machine.cycles()) * 1e-4);
}

/// Cycles get dearer by themselves: not a reason to change for good.
TEST(ThreadChoice, StaysWhereCyclesGetDearer)
{
    Machine machine(measured(2), [](int threads, double now) { return (now > 2.0 ? 3e-4 : 1e-4) / (threads == 2 ? 1.7 : 1.0); });
    machine.run(2.0);
    static_cast<void>(machine.share_on(2));
    machine.run(3.0);
    EXPECT_EQ(machine.chosen(), 2);
    EXPECT_GE(machine.share_on(2), 0.97);
}

/// A clock with noise of a fifth and stalls of some milliseconds.
TEST(ThreadChoice, FindsTheFasterNumberInSpiteOfNoise)
{
    std::mt19937 random(7);
    for (const int best : {1, 2})
    {
        Machine machine(measured(2),
                        [&](int threads, double)
                        {
                            const double noise = std::normal_distribution<>(1.0, 0.2)(random);
                            const double stall = std::uniform_real_distribution<>()(random) < 0.002 ? 1e-3 : 0.0;
                            return stall + std::max(0.1, noise) * (threads == best ? 0.8e-4 : 1e-4);
                        });
        machine.run(10.0);
        EXPECT_GE(machine.share_on(best), 0.9);
    }
}

/// Rows, frames and checks cut a run into short calls.
TEST(ThreadChoice, LooksAcrossShortCallsAsWell)
{
    Machine machine(measured(2), [](int threads, double) { return threads == 1 ? 1e-5 : 2e-5; });
    machine.run(2.0, 7);
    EXPECT_EQ(machine.chosen(), 1);
    EXPECT_GE(machine.share_on(1), 0.95);
}

TEST(ThreadChoice, GivesAModelNoMoreThreadsThanItHasWorkFor)
{
    Machine machine(measured(16), [](int threads, double) { return 1e-3 / threads; });
    machine.run(0.5);
    EXPECT_EQ(machine.chosen(), 16);
    machine.limit(3);
    for (int i = 0; i < 50; ++i)
    {
        machine.run(0.01);
        EXPECT_LE(machine.threads(), 3);
    }
    machine.limit(16);
    machine.run(3.0);
    EXPECT_EQ(machine.chosen(), 16);
}

/// Two runs at once begin with half of the processors each; who is left alone takes them all.
TEST(ThreadChoice, GrowsFromItsShareIntoWhatOthersLeave)
{
    const ThreadRule share = measured(4).for_share(2);
    EXPECT_EQ(share.most, 4);
    Machine machine(share, [](int threads, double now) { return threads <= 2 || now > 2.0 ? 1e-4 / threads : 2e-4; });
    EXPECT_EQ(machine.threads(), 2);
    machine.run(2.0);
    EXPECT_EQ(machine.chosen(), 2);
    machine.run(2.5);
    EXPECT_EQ(machine.chosen(), 4);
    EXPECT_EQ(ThreadRule(4).for_share(2).most, 2) << "a fixed number stays fixed";
}

TEST(ThreadChoice, SaysWhatWasChosenAndWhen)
{
    Machine machine(measured(2), [](int threads, double now) { return threads == 2 && now > 1.0 ? 5e-4 : 1e-4 / threads; });
    machine.run(3.0);
    const ThreadUse& use = machine.use();
    EXPECT_EQ(use.cycles[1] + use.cycles[2], machine.cycles());
    ASSERT_EQ(use.changes.size(), 2U);
    EXPECT_EQ(use.changes[0].cycle, 0);
    EXPECT_EQ(use.changes[0].threads, 2);
    EXPECT_NEAR(static_cast<double>(use.changes[1].cycle), 20'000.0, 2'000.0);
    EXPECT_EQ(use.changes[1].threads, 1);
    EXPECT_GT(use.trials, 2);
}

TEST(ThreadChoice, OfTheTestsUsesAllNumbersInTurn)
{
    Machine machine({3, ThreadRule::Kind::shuffled}, [](int, double) { return 1e-4; });
    machine.run(1.0);
    for (int threads = 1; threads <= 3; ++threads)
        EXPECT_GT(machine.use().cycles[threads], machine.cycles() / 5);
    EXPECT_GT(machine.use().changes.size(), 100U);
}
}  // namespace
}  // namespace hdem
