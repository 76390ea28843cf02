#pragma once
/// Numbers of joint sets that are drawn: dip, spacing, length, gap.

#include "core/model/distribution_def.h"

#include <boost/random/mersenne_twister.hpp>

#include <string>
#include <vector>

namespace hdem
{
/// A uniform number between 0 and 1, neither of them included; one number of the engine.
[[nodiscard]] double draw_share(boost::random::mt19937_64& engine);

/// One distribution, cut to [least, most].
///
/// A number is drawn by the inverse of the distribution function F: x = F^-1(F(least) + u (F(most) - F(least))), u uniform. So each number
/// takes one number of the stream, whatever its limits. The inverses are those of Boost.Math; of von Mises, which it does not have,
///
///   F(t) = 1/2 + t / 2 pi + 1/pi sum_j I_j(kappa) / I_0(kappa) sin(j t) / j        Mardia, Jupp (2000), Directional statistics, 3.5.4
///
/// is inverted. Numbers are rounded to 27 digits of base two of the distribution's size: logarithms and exponentials differ in the last
/// bit from one platform to another.
class Distribution
{
  public:
    /// @pre find_distribution_fault has none
    explicit Distribution(const DistributionDef& def);

    [[nodiscard]] double draw(boost::random::mt19937_64& engine) const { return quantile(draw_share(engine)); }

    /// Number below which a share of the truncated distribution lies. @pre 0 < share < 1
    [[nodiscard]] double quantile(double share) const;

    /// Mean of the truncated distribution.
    [[nodiscard]] double mean() const;

    /// Share of the whole distribution between least and most.
    [[nodiscard]] double kept() const { return upper_ - lower_; }

    /// Share of the whole distribution below x.
    [[nodiscard]] double share_below(double x) const;

  private:
    [[nodiscard]] double inverse(double share) const;
    [[nodiscard]] double inverse_of_von_mises(double share) const;

    DistributionDef def_;
    double mu_ = 0.0;  ///< lognormal: mean and standard deviation of the logarithm
    double sigma_ = 0.0;
    double unit_ = 0.0;          ///< to a multiple of which numbers are rounded
    std::vector<double> ratio_;  ///< I_j / (j I_0), from j = 1
    double lower_ = 0.0;         ///< share below least
    double upper_ = 1.0;         ///< share below most
};

/// What is wrong with a distribution.
struct DistributionFault
{
    std::string key;  ///< "sd"; empty: the whole
    std::string why;
    std::string remedy;
};

/// The first fault; an empty `why`: none. @param is_length  numbers must be positive
[[nodiscard]] DistributionFault find_distribution_fault(const DistributionDef& def, bool is_length);
}  // namespace hdem
