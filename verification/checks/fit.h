#pragma once
/// Lines and zero crossings in samples.

#include <cstdint>
#include <vector>

namespace hdem::verification
{
struct Line
{
    double value = 0.0;  ///< at `from`
    double slope = 0.0;  ///< per sample
    double from = 0.0;
    [[nodiscard]] double at(double sample) const { return value + slope * (sample - from); }
};

/// Least squares through samples first, ..., last - 1.
[[nodiscard]] Line fit_line(const std::vector<double>& samples, std::int64_t first, std::int64_t last);

/// Mean distance between upward crossings of the samples' mean, in samples; not a number with fewer than two of them.
[[nodiscard]] double mean_period(const std::vector<double>& samples);
}  // namespace hdem::verification
