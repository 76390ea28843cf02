#include "tools/hdem/timing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
    if (!threads.empty())
    {
        std::vector<double> unused;
        for (std::size_t i = 0; i < threads.size(); ++i)
        {
            unused.push_back(std::max(0.0, threads.front().total() - threads[i].total()));
            rest[i] -= unused.back();
        }
        rows.push_back(row("unused", unused, seconds));
    }
    rows.push_back(row("output", {output}, seconds));
    rows.push_back(row("other", rest, seconds));
    return rows;
}

ThreadSummary summarise_threads(const ThreadChoice& choice)
{
    const ThreadUse& use = choice.use();
    ThreadSummary summary{.fixed = choice.rule().is_fixed(), .trials = use.trials};
    const auto all = static_cast<double>(
        std::max<std::int64_t>(1, std::accumulate(use.cycles.begin(), use.cycles.end(), std::int64_t{0})));
    for (const std::int64_t cycles : use.cycles)
        summary.share.push_back(static_cast<double>(cycles) / all);
    for (const ThreadUse::Change& change : use.changes)
        summary.changes.push_back({.cycle = change.cycle, .threads = change.threads});
    return summary;
}

std::string thread_line(const ThreadSummary& use)
{
    std::vector<std::string> shares, changes;
    for (std::size_t n = 0; n < use.share.size(); ++n)
        if (use.share[n] > 0.0)
            shares.push_back(fmt::format("{:.3g} % on {}", 100.0 * use.share[n], n));
    if (shares.empty())
        return "threads   no cycles";
    constexpr std::size_t shown = 8;
    for (std::size_t i = 0; i < std::min(shown, use.changes.size()); ++i)
        changes.push_back(fmt::format("{} from cycle {}", use.changes[i].threads, use.changes[i].cycle));
    return fmt::format(
        "threads   cycles: {}{}", fmt::join(shares, ", "),
        use.fixed ? ""
                  : fmt::format("; chosen {}{}; {} trials of others", fmt::join(changes, ", "),
                                use.changes.size() > shown ? fmt::format(" and {} more changes", use.changes.size() - shown) : "",
                                use.trials));
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
