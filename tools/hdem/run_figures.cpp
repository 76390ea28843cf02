#include "tools/hdem/run_figures.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace hdem
{
Index free_blocks(const State& state)
{
    Index count = 0;
    for (Index i = 0; i < state.blocks.size(); ++i)
        count += state.blocks.is_free(i) ? 1 : 0;
    return count;
}

Index present_blocks(const State& state)
{
    return std::accumulate(state.blocks.present.begin(), state.blocks.present.end(), Index{0});
}

double smallest_free_mass(const Model& model, const State& state)
{
    double mass = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (state.blocks.is_free(i))
            mass = std::min(mass, model.mass[i]);
    return mass;
}

double peak_megabytes()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string first_of(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 10;
    const auto shown = static_cast<std::ptrdiff_t>(std::min(most, names.size()));
    return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + shown, ", "),
                       names.size() > most ? fmt::format(" and {} more", names.size() - most) : "");
}
}  // namespace hdem
