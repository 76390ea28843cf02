#include "perf/limits.h"

#include "core/simd.h"
#include "parallel/openmp.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace hdem::perf
{
namespace
{
static_assert(lanes == 4, "flops_each counts four lanes");

template <typename Work>
double seconds_of(const Work& work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void compute()
{
    Pack x[flops_chains];
    for (int k = 0; k < flops_chains; ++k)
        x[k] = Pack(1.0 + 0.1 * k);
    for (int i = 0; i < flops_rounds; ++i)
        for (int k = 0; k < flops_chains; ++k)
            x[k] = x[k] * Pack(0.999999) + Pack(1e-6);
    Pack all = x[0];
    for (int k = 1; k < flops_chains; ++k)
        all += x[k];
    double result = sum(all);
    benchmark::DoNotOptimize(result);
}
}  // namespace

double time_triad(int threads)
{
    static std::vector<double> a(triad_size, 0.0), b(triad_size, 1.0), c(triad_size, 2.0);
    return seconds_of(
        [&]
        {
            with_team(threads,
                      [&](const Team& team)
                      {
                          const IndexRange mine = team.share(triad_size / lanes);
                          for (Index i = lanes * mine.begin; i < lanes * mine.end; i += lanes)
                              (Pack::load(&b[i]) + Pack(3.0) * Pack::load(&c[i])).store(&a[i]);
                      });
            benchmark::DoNotOptimize(a.data());
        });
}

double time_flops(int threads)
{
    return seconds_of([&] { with_team(threads, [](const Team&) { compute(); }); });
}

void Limits::look()
{
    ++looks_;
    flops_seconds_ += time_flops(threads_);
    if (with_memory_)
        triad_seconds_ += time_triad(threads_);
}

double Limits::flops() const
{
    return looks_ * flops_each * threads_ / flops_seconds_;
}

void Limits::report_operations(benchmark::State& bench, double points, double seconds) const
{
    bench.counters["flops_per_second"] = flops();
    bench.counters["machine_operations_per_point"] = flops() * seconds / points;
}

void Limits::report_roofline(benchmark::State& bench, double points, double seconds) const
{
    double roof = flops() / operations_a_point;
    if (with_memory_)
    {
        const double bytes = looks_ * triad_bytes / triad_seconds_;
        bench.counters["bytes_per_second"] = bytes;
        roof = std::min(roof, bytes / bytes_a_point);
    }
    bench.counters["roofline_share"] = points / seconds / roof;
}
}  // namespace hdem::perf
