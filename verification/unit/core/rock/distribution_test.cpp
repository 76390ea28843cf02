#include "core/rock/distribution.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace hdem
{
namespace
{
using testing::HasSubstr;

DistributionDef law(DistributionKind kind, double mean, double sd_or_kappa = 0.0, std::optional<double> least = {},
                    std::optional<double> most = {})
{
    DistributionDef def{.kind = kind, .mean = mean, .least = least, .most = most};
    (kind == DistributionKind::von_mises ? def.kappa : def.sd) = sd_or_kappa;
    return def;
}

std::vector<double> drawn(const DistributionDef& def, std::size_t count, std::uint64_t seed)
{
    const Distribution distribution(def);
    boost::random::mt19937_64 engine(seed);
    std::vector<double> numbers(count);
    for (double& x : numbers)
        x = distribution.draw(engine);
    return numbers;
}

double normal_below(double z)
{
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

/// Integral of exp(kappa (cos t - 1)) by Simpson's rule.
double von_mises_below(double degrees, double kappa)
{
    constexpr int steps = 20'000;
    const auto integral = [&](double to)
    {
        const double h = (to + std::numbers::pi) / steps;
        double sum = 0.0;
        for (int i = 0; i <= steps; ++i)
            sum += (i == 0 || i == steps ? 1.0 : 2.0 + 2.0 * (i % 2)) *
                   std::exp(kappa * (std::cos(i * h - std::numbers::pi) - 1.0));
        return sum * h;
    };
    return integral(degrees * std::numbers::pi / 180.0) / integral(std::numbers::pi);
}

struct Known
{
    const char* name;
    DistributionDef def;
    std::function<double(double)> below;  ///< share below x, before it is cut
};

std::vector<Known> all_known()
{
    const double s2 = std::log(1.0 + 0.25), mu = std::log(4.0) - 0.5 * s2;  // lognormal, mean 4, sd 2
    return {
        {"uniform", law(DistributionKind::uniform, 0.0, 0.0, -3.0, 5.0), [](double x) { return (x + 3.0) / 8.0; }},
        {"uniform by sd", law(DistributionKind::uniform, 2.0, 0.5), [](double x) { return (x - 2.0) / std::sqrt(3.0) + 0.5; }},
        {"normal", law(DistributionKind::normal, 25.0, 4.0), [](double x) { return normal_below((x - 25.0) / 4.0); }},
        {"normal, cut", law(DistributionKind::normal, 25.0, 4.0, 20.0, 27.0),
         [](double x) { return normal_below((x - 25.0) / 4.0); }},
        {"exponential", law(DistributionKind::exponential, 1.2), [](double x) { return 1.0 - std::exp(-x / 1.2); }},
        {"exponential, cut", law(DistributionKind::exponential, 1.0, 0.0, 0.2, 3.0), [](double x) { return 1.0 - std::exp(-x); }},
        {"lognormal", law(DistributionKind::lognormal, 4.0, 2.0),
         [=](double x) { return normal_below((std::log(x) - mu) / std::sqrt(s2)); }},
        {"lognormal, cut", law(DistributionKind::lognormal, 4.0, 2.0, 2.0, 9.0),
         [=](double x) { return normal_below((std::log(x) - mu) / std::sqrt(s2)); }},
        {"von Mises", law(DistributionKind::von_mises, -30.0, 50.0), [](double x) { return von_mises_below(x + 30.0, 50.0); }},
        {"von Mises, flat", law(DistributionKind::von_mises, 10.0, 0.5), [](double x) { return von_mises_below(x - 10.0, 0.5); }}};
}

/// Kolmogorov and Smirnov: the empirical distribution is nearer than 1.95 / sqrt(n) in 999 of 1000 draws.
TEST(Distribution, DrawsFollowItsFunction)
{
    for (const Known& known : all_known())
        for (const std::uint64_t seed : {1U, 2U, 3U})
        {
            SCOPED_TRACE(known.name);
            const std::size_t n = known.def.kind == DistributionKind::von_mises ? 1'000 : 20'000;
            std::vector<double> x = drawn(known.def, n, seed);
            std::sort(x.begin(), x.end());
            const double low = known.def.least ? known.below(*known.def.least) : 0.0;
            const double high = known.def.most ? known.below(*known.def.most) : 1.0;
            double worst = 0.0;
            for (std::size_t i = 0; i < n; ++i)
            {
                const double share = (known.below(x[i]) - low) / (high - low);
                worst = std::max({worst, std::abs(share - static_cast<double>(i) / static_cast<double>(n)),
                                  std::abs(share - static_cast<double>(i + 1) / static_cast<double>(n))});
            }
            EXPECT_LT(worst, 1.95 / std::sqrt(static_cast<double>(n)));
            EXPECT_GE(x.front(), known.def.least.value_or(-1e9));
            EXPECT_LE(x.back(), known.def.most.value_or(1e9));
        }
}

TEST(Distribution, SharesAreThoseOfTheFunction)
{
    for (const Known& known : all_known())
    {
        SCOPED_TRACE(known.name);
        const Distribution distribution(known.def);
        for (const double share : {0.01, 0.3, 0.5, 0.77, 0.999})
        {
            const double x = distribution.quantile(share);
            EXPECT_NEAR(distribution.share_below(x), known.below(x), 1e-9);
        }
    }
}

TEST(Distribution, MeansAfterCutting)
{
    EXPECT_NEAR(Distribution(law(DistributionKind::exponential, 1.0, 0.0, 0.2, 3.0)).mean(), 1.018707, 5e-7);
    EXPECT_EQ(Distribution(law(DistributionKind::exponential, 1.3)).mean(), 1.3);
    EXPECT_NEAR(Distribution(law(DistributionKind::exponential, 2.0, 0.0, 0.4)).mean(), 2.4, 1e-8) << "it forgets";
    // Of a normal distribution: mean + sd (p(a) - p(b)) / (P(b) - P(a)).
    const auto density = [](double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); };
    const double a = -1.25, b = 0.5;
    EXPECT_NEAR(Distribution(law(DistributionKind::normal, 25.0, 4.0, 20.0, 27.0)).mean(),
                25.0 + 4.0 * (density(a) - density(b)) / (normal_below(b) - normal_below(a)), 1e-8);
    EXPECT_NEAR(Distribution(law(DistributionKind::von_mises, 10.0, 5.0, -20.0, 40.0)).mean(), 10.0, 1e-8);
    for (const Known& known : all_known())  // and what is drawn has it, within four standard errors
    {
        SCOPED_TRACE(known.name);
        const std::vector<double> x = drawn(known.def, 4'000, 7);
        double sum = 0.0, squares = 0.0;
        for (const double value : x)
        {
            sum += value;
            squares += value * value;
        }
        const double mean = sum / 4'000.0, error = std::sqrt((squares / 4'000.0 - mean * mean) / 4'000.0);
        EXPECT_NEAR(mean, Distribution(known.def).mean(), 4.0 * error);
    }
}

/// Digits beyond the 27th of base two are those in which libraries differ.
TEST(Distribution, NumbersHaveFewDigits)
{
    for (const double x : drawn(law(DistributionKind::lognormal, 4.0, 2.0), 100, 1))
        EXPECT_EQ(std::ldexp(x, 26), std::round(std::ldexp(x, 26)));
}

TEST(Distribution, EachNumberTakesOneOfTheStream)
{
    boost::random::mt19937_64 one(5), other(5);
    (void)Distribution(law(DistributionKind::exponential, 1.0, 0.0, 0.2, 3.0)).draw(one);
    other.discard(1);
    EXPECT_EQ(one(), other());
}

TEST(Distribution, FaultsAreNamed)
{
    const auto fault = [](const DistributionDef& def, bool is_length = true)
    {
        const DistributionFault found = find_distribution_fault(def, is_length);
        return found.key + ": " + found.why;
    };
    EXPECT_THAT(fault(law(DistributionKind::normal, 1.0)), HasSubstr("sd: is missing"));
    EXPECT_THAT(fault(law(DistributionKind::normal, 1.0, 0.1)), HasSubstr("least: is missing"));
    EXPECT_EQ(fault(law(DistributionKind::normal, 1.0, 0.1), false), ": ");
    EXPECT_THAT(fault(law(DistributionKind::von_mises, 0.0, 2e4), false), HasSubstr("kappa: must be > 0 and <= 10000"));
    EXPECT_THAT(fault(law(DistributionKind::exponential, 1.0, 0.0, 3.0, 2.0)), HasSubstr("most: must be greater than least, 3"));
    EXPECT_THAT(fault(law(DistributionKind::exponential, 1.0, 0.0, 20.0)), HasSubstr("of the distribution"));
    EXPECT_THAT(fault(law(DistributionKind::uniform, 5.0, 0.0, 0.0, 1.0)), HasSubstr("mean: is not the middle"));
    EXPECT_THAT(fault(law(DistributionKind::uniform, 1.0, 2.0)), HasSubstr("negative"));
}
}  // namespace
}  // namespace hdem
