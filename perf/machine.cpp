/// What the machine can do, in the same run: machine/triad/<threads> (bytes/s from memory), machine/flops/<threads> (double precision).

#include "perf/limits.h"
#include "perf/scene_run.h"

namespace hdem::perf
{
namespace
{
void time_rate(benchmark::State& bench, const char* counter, double amount, Elapsed (*time)(int), int threads)
{
    time(threads);
    double seconds = 0.0;
    for (auto _ : bench)
    {
        const double passed = time(threads).wall;
        bench.SetIterationTime(passed);
        seconds += passed;
    }
    bench.counters[counter] = amount * static_cast<double>(bench.iterations()) / seconds;
}

[[maybe_unused]] const bool registered = []
{
    for (const int threads : thread_counts())
    {
        benchmark::RegisterBenchmark(("machine/triad/" + std::to_string(threads)).c_str(), [=](benchmark::State& bench)
                                     { time_rate(bench, "bytes_per_second", triad_bytes, time_triad, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("machine/flops/" + std::to_string(threads)).c_str(), [=](benchmark::State& bench)
                                     { time_rate(bench, "flops_per_second", flops_each * threads, time_flops, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();
}  // namespace
}  // namespace hdem::perf
