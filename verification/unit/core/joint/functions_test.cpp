#include "core/joint/functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hdem
{
namespace
{
/// Greatest relative error against libm in long double, and four lanes against one.
template <typename Own, typename Exact>
void expect_close(double from, double to, double bar, const Own& own, const Exact& exact)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> in(from, to);
    for (int k = 0; k < 50000; ++k)
    {
        const std::array<double, 4> x{in(random), in(random), in(random), in(random)};
        const Pack four = own(Pack::load(x.data()));
        for (int i = 0; i < lanes; ++i)
        {
            const double one = own(x[static_cast<std::size_t>(i)]);
            ASSERT_EQ(std::bit_cast<std::uint64_t>(one), std::bit_cast<std::uint64_t>(double{four.v[i]}));
            const long double truth = exact(static_cast<long double>(x[static_cast<std::size_t>(i)]));
            ASSERT_LE(std::abs(static_cast<double>((one - truth) / truth)), bar) << x[static_cast<std::size_t>(i)];
        }
    }
}
const auto own_log = [](auto x) { return hdem::log(x); };
const auto own_exp = [](auto x) { return hdem::exp(x); };
const auto own_tan = [](auto x) { return hdem::tan(x); };

TEST(Functions, LogarithmIsThatOfLibmInFourLanesAndOne)
{
    const auto exact = [](long double x) { return std::log(x); };
    expect_close(0.5, 2.0, 5e-16, own_log, exact);
    expect_close(1e-3, 1e12, 5e-16, own_log, exact);
    expect_close(0.999, 1.001, 5e-16, own_log, exact);
    EXPECT_EQ(hdem::log(1.0), 0.0);
    EXPECT_LT(hdem::log(0.0), -700.0);
}

TEST(Functions, ExponentialIsThatOfLibmInFourLanesAndOne)
{
    const auto exact = [](long double x) { return std::exp(x); };
    expect_close(-40.0, 40.0, 5e-16, own_exp, exact);
    expect_close(-700.0, 700.0, 5e-16, own_exp, exact);
    expect_close(-1e-3, 1e-3, 5e-16, own_exp, exact);
    EXPECT_EQ(hdem::exp(0.0), 1.0);
    EXPECT_GT(hdem::exp(-1e9), 0.0);
    EXPECT_TRUE(std::isfinite(hdem::exp(1e9)));
}

TEST(Functions, TangentIsThatOfLibmInFourLanesAndOne)
{
    const auto exact = [](long double x) { return std::tan(x); };
    expect_close(-1.5, 1.5, 7e-16, own_tan, exact);
    expect_close(-1e-3, 1e-3, 5e-16, own_tan, exact);
    EXPECT_EQ(hdem::tan(0.0), 0.0);
}

TEST(Functions, PowerIsThatOfLibmInFourLanesAndOne)
{
    expect_close(
        1e-3, 1e3, 2e-15, [](auto x) { return power(x, decltype(x)(0.33)); },
        [](long double x) { return std::pow(x, static_cast<long double>(0.33)); });
    expect_close(
        1e-2, 1e8, 1e-14, [](auto x) { return power(x, decltype(x)(2.5)); }, [](long double x) { return std::pow(x, 2.5L); });
}
}  // namespace
}  // namespace hdem
