/// Bare force loops: yardstick/<plain_loop, force_loop>/wall/<blocks>/<threads>.

#include "perf/counters.h"
#include "perf/force_loop.h"
#include "perf/limits.h"
#include "perf/plain_loop.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace hdem::perf
{
namespace
{
template <typename Loop>
void run_loop(benchmark::State& bench, Index blocks, const std::string& family, int threads)
{
    Loop loop(static_cast<Index>(std::lround(std::sqrt(blocks))));
    const std::int64_t cycles = measured_cycles(blocks);
    loop.advance(cycles / 5 + 1, threads);
    Limits limits(threads, blocks >= 100'000);
    Elapsed time;
    for (auto _ : bench)
    {
        for (std::int64_t piece = 0; piece < pieces; ++piece)
        {
            limits.look();
            const Stopwatch watch;
            loop.advance(cycles * (piece + 1) / pieces - cycles * piece / pieces, threads);
            time += watch.elapsed();
        }
        bench.SetIterationTime(time.wall);
    }
    if (loop.closed_points() != loop.contact_points())
        return bench.SkipWithError("points have opened: the speed would be that of fewer points");
    if (std::abs(loop.supported_share() - 1.0) > 0.2)
        return bench.SkipWithError("the wall does not stand on its floor");
    const auto updates = static_cast<double>(loop.contact_points() * cycles);
    report_points(bench, updates);
    limits.report_operations(bench, updates, time);
    bench.counters["contact_points"] = static_cast<double>(loop.contact_points());
    bench.counters["blocks"] = static_cast<double>(loop.blocks());
    report_hash(bench, family, loop.hash());
}

template <typename Loop>
void add(const std::string& loop, Index blocks, int threads)
{
    const std::string family = "yardstick/" + loop + "/wall/" + std::to_string(blocks);
    benchmark::RegisterBenchmark((family + '/' + std::to_string(threads)).c_str(),
                                 [=](benchmark::State& bench) { run_loop<Loop>(bench, blocks, family, threads); })
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
}

[[maybe_unused]] const bool registered = []
{
    for (const Index blocks : {1'000, 10'000, 100'000, 1'000'000})
        for (const int threads : thread_counts())
        {
            add<PlainLoop>("plain_loop", blocks, threads);
            add<ForceLoop>("force_loop", blocks, threads);
        }
    return true;
}();
}  // namespace
}  // namespace hdem::perf
