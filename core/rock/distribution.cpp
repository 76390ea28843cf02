#include "core/rock/distribution.h"

#include "core/rock/problem_text.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hdem
{
namespace
{
constexpr double pi = std::numbers::pi;
constexpr double most_kappa = 1e4;
constexpr double least_kept = 1e-6;  // below it the shares at the limits have too few digits

using StandardNormal = boost::math::normal_distribution<double>;

/// Ratios I_j / (j I_0) of modified Bessel functions, by the recurrence r_j = I_j / I_(j-1) = 1 / (2 j / kappa + r_(j+1)) downwards.
std::vector<double> bessel_ratios(double kappa)
{
    const auto terms = static_cast<std::size_t>(20.0 + 9.0 * std::sqrt(kappa));
    std::vector<double> ratio(terms);
    double next = 0.0;
    for (std::size_t j = 2 * terms; j >= 1; --j)
    {
        next = 1.0 / (2.0 * static_cast<double>(j) / kappa + next);
        if (j <= terms)
            ratio[j - 1] = next;
    }
    for (std::size_t j = 1; j < terms; ++j)
        ratio[j] *= ratio[j - 1];
    for (std::size_t j = 0; j < terms; ++j)
        ratio[j] /= static_cast<double>(j + 1);
    return ratio;
}

/// 2^-26 of a power of two that is at least as great as the distribution's own size.
double rounding_unit(const DistributionDef& def, double lognormal_median)
{
    double size = std::max({std::abs(def.sd), def.kind == DistributionKind::von_mises ? 180.0 : 0.0,
                            def.kind == DistributionKind::exponential ? def.mean : 0.0, lognormal_median});
    if (def.kind == DistributionKind::uniform && def.least && def.most)
        size = *def.most - *def.least;
    int exponent = 0;
    std::frexp(size, &exponent);
    return std::ldexp(1.0, exponent - 26);
}
}  // namespace

double draw_share(boost::random::mt19937_64& engine)
{
    return (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53;
}

Distribution::Distribution(const DistributionDef& def) : def_(def)
{
    if (def.kind == DistributionKind::uniform && !(def.least && def.most))
    {
        const double half = std::sqrt(3.0) * def.sd;
        def_.least = std::max(def.least.value_or(def.mean - half), def.mean - half);
        def_.most = std::min(def.most.value_or(def.mean + half), def.mean + half);
    }
    double median = 0.0;
    if (def.kind == DistributionKind::lognormal)
    {
        const double share = def.sd / def.mean;
        const double variance = std::log1p(share * share);
        mu_ = std::log(def.mean) - 0.5 * variance;
        sigma_ = std::sqrt(variance);
        median = std::exp(mu_);
    }
    if (def.kind == DistributionKind::von_mises)
        ratio_ = bessel_ratios(def.kappa);
    unit_ = def.is_random() ? rounding_unit(def_, median) : 0.0;
    if (def.is_random() && def.kind != DistributionKind::uniform)
    {
        lower_ = def_.least ? share_below(*def_.least) : 0.0;
        upper_ = def_.most ? share_below(*def_.most) : 1.0;
    }
}

double Distribution::share_below(double x) const
{
    switch (def_.kind)
    {
    case DistributionKind::constant:
        return x < def_.mean ? 0.0 : 1.0;
    case DistributionKind::uniform:
        return std::clamp((x - *def_.least) / (*def_.most - *def_.least), 0.0, 1.0);
    case DistributionKind::normal:
        return boost::math::cdf(StandardNormal(), (x - def_.mean) / def_.sd);
    case DistributionKind::exponential:
        return x > 0.0 ? -std::expm1(-x / def_.mean) : 0.0;
    case DistributionKind::lognormal:
        return x > 0.0 ? boost::math::cdf(StandardNormal(), (std::log(x) - mu_) / sigma_) : 0.0;
    case DistributionKind::von_mises:
    {
        const double t = radians(std::clamp(x - def_.mean, -180.0, 180.0));
        double sum = 0.0;
        for (std::size_t j = 0; j < ratio_.size(); ++j)
            sum += ratio_[j] * std::sin(static_cast<double>(j + 1) * t);
        return std::clamp(0.5 + 0.5 * t / pi + sum / pi, 0.0, 1.0);
    }
    }
    return 0.0;
}

double Distribution::inverse_of_von_mises(double share) const
{
    const double low = def_.mean - 180.0, high = def_.mean + 180.0;
    const double at_low = share_below(low) - share, at_high = share_below(high) - share;
    if (at_low >= 0.0 || at_high <= 0.0)
        return at_low >= 0.0 ? low : high;
    std::uintmax_t steps = 200;
    const auto [a, b] = boost::math::tools::toms748_solve([&](double x) { return share_below(x) - share; }, low, high, at_low,
                                                          at_high, boost::math::tools::eps_tolerance<double>(48), steps);
    return 0.5 * (a + b);
}

double Distribution::inverse(double share) const
{
    switch (def_.kind)
    {
    case DistributionKind::constant:
        return def_.mean;
    case DistributionKind::uniform:
        return *def_.least + share * (*def_.most - *def_.least);
    case DistributionKind::normal:
        return def_.mean + def_.sd * boost::math::quantile(StandardNormal(), share);
    case DistributionKind::exponential:
        return -def_.mean * std::log1p(-share);
    case DistributionKind::lognormal:
        return std::exp(mu_ + sigma_ * boost::math::quantile(StandardNormal(), share));
    case DistributionKind::von_mises:
        return inverse_of_von_mises(share);
    }
    return 0.0;
}

double Distribution::quantile(double share) const
{
    if (!def_.is_random())
        return def_.mean;
    constexpr double smallest = std::numeric_limits<double>::min();
    const double within = std::clamp(lower_ + share * (upper_ - lower_), smallest, 1.0 - 0x1p-53);
    const double rounded = unit_ * std::round(inverse(within) / unit_);
    // Rounding must not lead out of the limits; a length is at least the unit, so that no two joints are one.
    const double least = def_.least.value_or(-std::numeric_limits<double>::infinity());
    const bool is_length = def_.kind == DistributionKind::exponential || def_.kind == DistributionKind::lognormal;
    return std::clamp(is_length ? std::max(rounded, unit_) : rounded, least,
                      std::max(least, def_.most.value_or(std::numeric_limits<double>::infinity())));
}

double Distribution::mean() const
{
    if (!def_.is_random())
        return def_.mean;
    if (def_.kind == DistributionKind::uniform)
        return 0.5 * (*def_.least + *def_.most);
    if (!def_.least && !def_.most)
        return def_.mean;
    // The mean is the integral of the inverse over the shares that are kept.
    boost::math::quadrature::tanh_sinh<double> integral;
    const double low = std::max(lower_, std::numeric_limits<double>::min()), high = std::min(upper_, 1.0 - 0x1p-53);
    return integral.integrate([&](double share) { return inverse(share); }, low, high, 1e-10) / (high - low);
}

namespace
{
/// Of the numbers that the kind needs.
DistributionFault find_missing(const DistributionDef& def)
{
    const bool has_limits = def.least && def.most;
    switch (def.kind)
    {
    case DistributionKind::uniform:
        if (!has_limits && !(def.sd > 0.0))
            return {"", "uniform: least and most are missing, and there is no sd", "Give least and most, or mean and sd."};
        break;
    case DistributionKind::normal:
    case DistributionKind::lognormal:
        if (!(def.sd > 0.0))
            return {"sd", "is missing, or not above 0", "Give the standard deviation in the unit of the mean."};
        break;
    case DistributionKind::von_mises:
        if (!(def.kappa > 0.0 && def.kappa <= most_kappa))
            return {"kappa", "must be > 0 and <= " + text(most_kappa), "Above it take normal, with sd = 57.3 / sqrt(kappa)."};
        break;
    default:
        break;
    }
    return {};
}
}  // namespace

DistributionFault find_distribution_fault(const DistributionDef& def, bool is_length)
{
    if (DistributionFault missing = find_missing(def); !missing.why.empty())
        return missing;
    if (!def.is_random())
        return {};
    if (def.least && def.most && !(*def.least < *def.most))
        return {"most", "must be greater than least, " + text(*def.least), "Exchange the two, or write a plain number."};
    if (def.kind == DistributionKind::uniform && def.least && def.most && def.sd == 0.0 && def.mean != 0.0 &&
        std::abs(def.mean - 0.5 * (*def.least + *def.most)) > 1e-9 * (*def.most - *def.least))
        return {"mean", "is not the middle of least and most", "Leave mean out, or correct one of the three."};
    if (def.kind == DistributionKind::uniform && def.least && def.most && def.sd > 0.0)
        return {"sd", "contradicts least and most", "Give least and most, or mean and sd."};
    const bool may_be_negative = def.kind == DistributionKind::normal || (def.kind == DistributionKind::uniform && !def.least);
    if (is_length && may_be_negative && !def.least &&
        !(def.kind == DistributionKind::uniform && def.mean > std::sqrt(3.0) * def.sd))
        return {"least", "is missing: some lengths would be negative", "Give the least length, 0 or more."};
    if (const double kept = Distribution(def).kept(); !(kept >= least_kept))
        return {"", "least and most leave " + text(kept) + " of the distribution, less than " + text(least_kept),
                "Give limits around the mean."};
    return {};
}
}  // namespace hdem
