#include "tools/hdem/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace hdem
{
namespace
{
constexpr std::array<const char*, static_cast<std::size_t>(CycleStage::count)> stage_names{"broad",   "narrow", "force",
                                                                                           "impulse", "update", "wait"};

StageTiming row(const char* name, const std::vector<double>& of_threads, double seconds)
{
    const auto [least, greatest] = std::ranges::minmax(of_threads);
    const double mean = std::accumulate(of_threads.begin(), of_threads.end(), 0.0) / static_cast<double>(of_threads.size());
    return {.name = name, .least = least, .mean = mean, .greatest = greatest, .share = mean / std::max(seconds, 1e-9)};
}
}  // namespace

std::vector<StageTiming> summarise_times(std::span<const StageTimes> threads, double output, double seconds)
{
    std::vector<StageTiming> rows;
    std::vector<double> rest(std::max<std::size_t>(threads.size(), 1), seconds - output);
    for (std::size_t stage = 0; stage < stage_names.size() && !threads.empty(); ++stage)
    {
        std::vector<double> of_threads;
        for (std::size_t i = 0; i < threads.size(); ++i)
        {
            of_threads.push_back(threads[i].seconds[stage]);
            rest[i] -= of_threads.back();
        }
        rows.push_back(row(stage_names[stage], of_threads, seconds));
    }
    rows.push_back(row("output", {output}, seconds));
    rows.push_back(row("other", rest, seconds));
    return rows;
}

std::vector<std::string> timing_table(std::span<const StageTiming> timing)
{
    std::vector<std::string> lines{"time of   least [s]   mean [s]  greatest [s]  share"};
    for (const StageTiming& t : timing)
        lines.push_back(
            fmt::format("{:<8} {:>10.3f} {:>10.3f} {:>13.3f} {:>5.1f} %", t.name, t.least, t.mean, t.greatest, 100.0 * t.share));
    return lines;
}
}  // namespace hdem
