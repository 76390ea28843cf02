#include "parallel/bracket_search.h"
#include "parallel/critical_search.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <stdexcept>

namespace hdem
{
namespace
{
/// Stands below a limit; notes which numbers count.
struct Asked
{
    double limit = 1.0;
    std::set<double> numbers{};
    std::mutex mutex{};

    Bracket find(const BracketRule& rule, int threads)
    {
        const StandsAt stands = [this](double x, int, const std::stop_token&)
        {
            const std::lock_guard lock(mutex);
            numbers.insert(x);
            return x < limit;
        };
        return search_bracket(rule, threads, stands);
    }
};

BracketRule rule()
{
    return {.low = 0.5, .high = 3.0, .tolerance = 0.01, .least = 1.0 / 128.0, .most = 64.0};
}

TEST(BracketSearch, FindsTheLimitWithinItsTolerance)
{
    for (const double limit : {0.02, 0.3, 0.77, 1.234, 2.99, 3.5, 17.0, 63.0})
        for (const int threads : {1, 2, 3})
        {
            Asked asked{.limit = limit};
            const Bracket found = asked.find(rule(), threads);
            ASSERT_TRUE(found.is_closed()) << limit;
            EXPECT_LT(*found.stands, limit);
            EXPECT_GE(*found.fails, limit);
            EXPECT_LE(*found.fails - *found.stands, 0.01 * (1.0 + 1e-9));
        }
}

TEST(BracketSearch, EndsWhereTheToleranceIsBelowRoundOff)
{
    for (const double scale : {1.0, 1e9})
        for (const double limit : {0.3 * scale, -0.7 * scale})
        {
            const StandsAt stands = [&](double x, int, const std::stop_token&) { return x < limit; };
            const Bracket found = search_bracket({.tolerance = 1e-300, .known = {-scale, scale}}, 1, stands);
            EXPECT_LT(*found.stands, limit);
            EXPECT_GE(*found.fails, limit);
            EXPECT_LT(*found.fails - *found.stands, 1e-15 * scale);
        }
}

TEST(BracketSearch, FindsTheSameOnAnyNumberOfThreads)
{
    for (const double limit : {0.1, 1.137, 5.0})
    {
        Asked one{.limit = limit}, two{.limit = limit};
        const Bracket a = one.find(rule(), 1), b = two.find(rule(), 2);
        EXPECT_EQ(*a.stands, *b.stands);
        EXPECT_EQ(*a.fails, *b.fails);
        for (const double x : one.numbers)
            EXPECT_TRUE(two.numbers.contains(x));
    }
}

TEST(BracketSearch, LooksAroundAGuessFirst)
{
    Asked asked{.limit = 1.5};
    BracketRule r = rule();
    r.guess = 1.5;
    const Bracket found = asked.find(r, 1);
    EXPECT_EQ(asked.numbers.size(), 2U);
    EXPECT_NEAR(found.middle(), 1.5, 1e-12);
    Asked wrong{.limit = 1.2};
    EXPECT_NEAR(wrong.find(r, 1).middle(), 1.2, 0.005);
}

TEST(BracketSearch, SaysWhereNothingFailsOrStands)
{
    Asked never{.limit = 1e9}, always{.limit = 0.0};
    const Bracket high = never.find(rule(), 2), low = always.find(rule(), 2);
    EXPECT_EQ(high.stands, 64.0);
    EXPECT_FALSE(high.fails);
    EXPECT_EQ(low.fails, 1.0 / 128.0);
    EXPECT_FALSE(low.stands);
}

TEST(BracketSearch, PassesOnWhatATrialThrows)
{
    for (const int threads : {1, 2})
        EXPECT_THROW(static_cast<void>(search_bracket(rule(), threads,
                                                      [](double x, int, const std::stop_token&) -> bool
                                                      {
                                                          if (x > 1.0)
                                                              throw std::runtime_error("trial");
                                                          return true;
                                                      })),
                     std::runtime_error);
}

TEST(BracketSearch, SearchesDownwardsWhereTheLowEndFails)
{
    const Bracket found = search_between({60.0, 0.0}, 0.1, 2, [](double x, int, const std::stop_token&) { return x > 34.3; });
    EXPECT_NEAR(found.middle(), 34.3, 0.1);
    EXPECT_GT(*found.stands, *found.fails);
}
}  // namespace
}  // namespace hdem
