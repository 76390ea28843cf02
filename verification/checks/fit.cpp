#include "verification/checks/fit.h"

#include <limits>
#include <numeric>

namespace hdem::verification
{
Line fit_line(const std::vector<double>& samples, std::int64_t first, std::int64_t last)
{
    const auto n = static_cast<double>(last - first);
    const double middle = 0.5 * static_cast<double>(first + last - 1);
    double sum = 0.0;
    double cross = 0.0;
    double square = 0.0;
    for (std::int64_t i = first; i < last; ++i)
    {
        const double x = static_cast<double>(i) - middle;
        sum += samples.at(static_cast<std::size_t>(i));
        cross += x * samples[static_cast<std::size_t>(i)];
        square += x * x;
    }
    return {.value = sum / n, .slope = cross / square, .from = middle};
}

double mean_period(const std::vector<double>& samples)
{
    const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
    double first = -1.0;
    double last = -1.0;
    int crossings = 0;
    for (std::size_t i = 1; i < samples.size(); ++i)
    {
        const double before = samples[i - 1] - mean;
        const double after = samples[i] - mean;
        if (before < 0.0 && after >= 0.0)
        {
            last = static_cast<double>(i - 1) - before / (after - before);
            first = crossings == 0 ? last : first;
            ++crossings;
        }
    }
    return crossings > 1 ? (last - first) / (crossings - 1) : std::numeric_limits<double>::quiet_NaN();
}
}  // namespace hdem::verification
