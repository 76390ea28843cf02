#include "parallel/team.h"
#include "parallel/waiting.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

namespace hdem
{
namespace
{
using namespace std::chrono_literals;

double seconds_of_processors()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// A plain number handed from thread to thread: a call that is missed hangs, one that hands on too little is a race for ThreadSanitizer.
TEST(Signal, HandsOnWhatWasWrittenBeforeItAndMissesNoCall)
{
    Signal to, from;
    std::int64_t number = 0;
    constexpr std::uint32_t rounds = 5'000;
    std::thread other(
        [&]
        {
            for (std::uint32_t i = 0; i < rounds; ++i)
            {
                to.wait(i);
                ++number;
                if (i % 500 == 0)
                    std::this_thread::sleep_for(1ms);  // the caller falls asleep
                from.call();
            }
        });
    for (std::uint32_t i = 0; i < rounds; ++i)
    {
        ASSERT_EQ(number, i);
        if (i % 500 == 250)
            std::this_thread::sleep_for(1ms);  // the other falls asleep
        to.call();
        from.wait(i);
    }
    other.join();
    EXPECT_EQ(number, rounds);
}

TEST(Signal, LetsWhoWaitsLongSleep)
{
    Signal signal;
    std::thread other([&] { signal.wait(0); });
    const double before = seconds_of_processors();
    std::this_thread::sleep_for(300ms);
    EXPECT_LT(seconds_of_processors() - before, 0.05) << "a thread that spins takes 0.3 s";
    signal.call();
    other.join();
}

/// Sums that each member forms from what all have written before the barrier.
TEST(Barrier, IsPassedByNobodyBeforeAllHaveCome)
{
    constexpr int threads = 4, rounds = 300;
    Barrier barrier;
    std::array<std::int64_t, threads> written{};
    std::array<bool, threads> is_right{};
    std::vector<std::thread> all;
    for (int member = 0; member < threads; ++member)
        all.emplace_back(
            [&, member]
            {
                bool right = true;
                for (int i = 0; i < rounds; ++i)
                {
                    written[member] = i * (member + 1);
                    barrier.pass(threads);
                    right = right && std::accumulate(written.begin(), written.end(), std::int64_t{0}) == i * 10;
                    barrier.pass(threads);
                }
                is_right[member] = right;
            });
    for (std::thread& thread : all)
        thread.join();
    for (const bool right : is_right)
        EXPECT_TRUE(right);
}

TEST(Crew, GivesEachMemberItsShareWhateverTheNumberBefore)
{
    std::vector<int> done(1000);
    std::int64_t rounds = 0;
    for (int i = 0; i < 50; ++i)
        for (const int threads : {2, 5, 1, 3})
        {
            with_team(threads,
                      [&](const Team& team)
                      {
                          const IndexRange mine = team.share(1000);
                          for (Index k = mine.begin; k < mine.end; ++k)
                              ++done[k];
                          team.barrier();
                          team.deal(1000, [&](Index k) { ++done[k]; });
                          team.alone([&] { rounds += team.threads() <= threads ? 1 : 0; });
                      });
            ASSERT_EQ(rounds, 4 * i + (threads == 2 ? 1 : threads == 5 ? 2 : threads == 1 ? 3 : 4));
        }
    EXPECT_EQ(std::set<int>(done.begin(), done.end()), std::set<int>{400});
}

TEST(Crew, SleepsBetweenTeams)
{
    std::vector<std::int64_t> sums(3);
    with_team(3, [&](const Team& team) { ++sums[team.member()]; });
    const double before = seconds_of_processors();
    std::this_thread::sleep_for(300ms);
    EXPECT_LT(seconds_of_processors() - before, 0.05);
    with_team(3, [&](const Team& team) { ++sums[team.member()]; });
    EXPECT_GE(sums[0], 2);
}

TEST(Crew, LetsSomebodyWhoWaitsForASlowMemberSleep)
{
    const double before = seconds_of_processors();
    with_team(3,
              [&](const Team& team)
              {
                  if (team.is_first())
                      std::this_thread::sleep_for(300ms);
                  team.barrier();
              });
    EXPECT_LT(seconds_of_processors() - before, 0.05);
}

TEST(Crew, WorksAloneWithinATeam)
{
    std::vector<int> threads(3);
    with_team(3, [&](const Team& team) { with_team(2, [&](const Team& inner) { threads[team.member()] = inner.threads(); }); });
    for (const int n : threads)
        EXPECT_LE(n, 1);
    EXPECT_EQ(threads[0], 1);
}

/// Each calling thread has its own.
TEST(Crew, ServesSeveralCallersAtOnce)
{
    std::array<std::int64_t, 3> sums{};
    std::vector<std::thread> callers;
    for (int caller = 0; caller < 3; ++caller)
        callers.emplace_back(
            [&, caller]
            {
                for (int i = 0; i < 200; ++i)
                {
                    std::array<std::int64_t, 3> parts{};
                    with_team(1 + (i + caller) % 3,
                              [&](const Team& team)
                              {
                                  const IndexRange mine = team.share(90);
                                  parts[team.member()] = mine.end - mine.begin;
                              });
                    sums[caller] += parts[0] + parts[1] + parts[2];
                }
            });
    for (std::thread& caller : callers)
        caller.join();
    for (const std::int64_t sum : sums)
        EXPECT_EQ(sum, 200 * 90);
}
}  // namespace
}  // namespace hdem
