#pragma once
/// How a number of a joint set is distributed, as a case file says it.

#include <optional>

namespace hdem
{
enum class DistributionKind
{
    constant,
    uniform,      ///< between least and most, or by mean and sd
    normal,       ///< mean, sd
    von_mises,    ///< mean, kappa: angles
    exponential,  ///< mean
    lognormal     ///< mean, sd: of the number itself, not of its logarithm
};

/// mean, sd and kappa are those of the distribution before it is cut to [least, most]; in the unit of the number.
struct DistributionDef
{
    DistributionKind kind = DistributionKind::constant;
    double mean = 0.0;
    double sd = 0.0;
    double kappa = 0.0;  ///< [-]
    std::optional<double> least;
    std::optional<double> most;

    [[nodiscard]] bool is_random() const { return kind != DistributionKind::constant; }

    bool operator==(const DistributionDef&) const = default;
};
}  // namespace hdem
