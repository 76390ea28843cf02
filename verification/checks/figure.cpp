#include "verification/checks/figure.h"

#include <algorithm>
#include <utility>

namespace hdem::verification
{
Series sampled(const std::string& name, const std::vector<double>& samples, std::size_t first, std::size_t last, double x_factor)
{
    Series series{.name = name};
    for (std::size_t i = first; i < std::min(last, samples.size()); ++i)
    {
        series.x.push_back(x_factor * static_cast<double>(i));
        series.y.push_back(samples[i]);
    }
    return series;
}

Series level(const std::string& name, Origin origin, double y, double x0, double x1)
{
    return {.name = name, .origin = origin, .x = {x0, x1}, .y = {y, y}};
}

Series point(const std::string& name, Origin origin, double x, double y)
{
    return {.name = name, .origin = origin, .x = {x}, .y = {y}, .dots = true};
}

void thin(Series& series, std::size_t most)
{
    const std::size_t n = series.x.size();
    if (n <= most)
        return;
    const std::size_t stretches = (most - 2) / 2;
    std::vector<std::size_t> kept{0};
    for (std::size_t s = 0; s < stretches; ++s)
    {
        const auto begin = series.y.begin() + static_cast<std::ptrdiff_t>(1 + s * (n - 2) / stretches);
        const auto end = series.y.begin() + static_cast<std::ptrdiff_t>(1 + (s + 1) * (n - 2) / stretches);
        const auto [low, high] = std::minmax_element(begin, end);
        const auto [first, second] = std::minmax({low - series.y.begin(), high - series.y.begin()});
        kept.push_back(static_cast<std::size_t>(first));
        if (second != first)
            kept.push_back(static_cast<std::size_t>(second));
    }
    kept.push_back(n - 1);
    std::vector<double> x;
    std::vector<double> y;
    for (const std::size_t i : kept)
    {
        x.push_back(series.x[i]);
        y.push_back(series.y[i]);
    }
    series.x = std::move(x);
    series.y = std::move(y);
}
}  // namespace hdem::verification
