/// What the machine can do, in the same run: machine/triad/<threads> (bytes/s from memory), machine/flops/<threads> (double precision).

#include "core/simd.h"
#include "parallel/openmp.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <functional>
#include <string>

namespace hdem::perf
{
namespace
{
void time_rate(benchmark::State& bench, const char* counter, double amount, const std::function<void()>& work)
{
    work();
    double seconds = 0.0;
    for (auto _ : bench)
    {
        const auto begin = std::chrono::steady_clock::now();
        work();
        const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        bench.SetIterationTime(passed);
        seconds += passed;
    }
    bench.counters[counter] = amount * static_cast<double>(bench.iterations()) / seconds;
}

/// STREAM's triad a = b + s c (McCalpin 1995), counted as there: two arrays read, one written.
void triad(benchmark::State& bench, int threads)
{
    const Index n = 16'000'000;  // 384 MB, far beyond any cache
    static std::vector<double> a, b, c;
    a.assign(static_cast<std::size_t>(n), 0.0);
    b.assign(static_cast<std::size_t>(n), 1.0);
    c.assign(static_cast<std::size_t>(n), 2.0);
    time_rate(bench, "bytes_per_second", 24.0 * n,
              [&]
              {
                  with_team(threads,
                            [&](const Team& team)
                            {
                                const IndexRange mine = team.share(n / lanes);
                                for (Index i = lanes * mine.begin; i < lanes * mine.end; i += lanes)
                                    (Pack::load(&b[i]) + Pack(3.0) * Pack::load(&c[i])).store(&a[i]);
                            });
                  benchmark::DoNotOptimize(a.data());
              });
}

/// Independent multiplications and additions on registers. Without fused multiply-add, which the laws do without too.
void flops(benchmark::State& bench, int threads)
{
    constexpr int rounds = 1'000'000;
    constexpr int chains = 8;
    time_rate(bench, "flops_per_second", 2.0 * lanes * chains * rounds * threads,
              [&]
              {
                  with_team(threads,
                            [&](const Team&)
                            {
                                Pack x[chains];
                                for (int k = 0; k < chains; ++k)
                                    x[k] = Pack(1.0 + 0.1 * k);
                                for (int i = 0; i < rounds; ++i)
                                    for (int k = 0; k < chains; ++k)
                                        x[k] = x[k] * Pack(0.999999) + Pack(1e-6);
                                Pack all = x[0];
                                for (int k = 1; k < chains; ++k)
                                    all += x[k];
                                double result = sum(all);
                                benchmark::DoNotOptimize(result);
                            });
              });
}

[[maybe_unused]] const bool registered = []
{
    for (const int threads : {1, 2})
    {
        benchmark::RegisterBenchmark(("machine/triad/" + std::to_string(threads)).c_str(),
                                     [=](benchmark::State& bench) { triad(bench, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("machine/flops/" + std::to_string(threads)).c_str(),
                                     [=](benchmark::State& bench) { flops(bench, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();
}  // namespace
}  // namespace hdem::perf
