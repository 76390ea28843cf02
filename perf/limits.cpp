#include "perf/limits.h"

#include "core/simd.h"
#include "parallel/team.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace hdem::perf
{
namespace
{
static_assert(lanes == 4, "flops_each counts four lanes");

double processor_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
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

Elapsed& Elapsed::operator+=(const Elapsed& other)
{
    wall += other.wall;
    processor += other.processor;
    return *this;
}

Stopwatch::Stopwatch() : begin_{wall_seconds(), processor_seconds()}
{
}

Elapsed Stopwatch::elapsed() const
{
    return {wall_seconds() - begin_.wall, processor_seconds() - begin_.processor};
}

Elapsed time_triad(int threads)
{
    static std::vector<double> a(triad_size, 0.0), b(triad_size, 1.0), c(triad_size, 2.0);
    const Stopwatch watch;
    with_team(threads,
              [&](const Team& team)
              {
                  const IndexRange mine = team.share(triad_size / lanes);
                  for (Index i = lanes * mine.begin; i < lanes * mine.end; i += lanes)
                      (Pack::load(&b[i]) + Pack(3.0) * Pack::load(&c[i])).store(&a[i]);
              });
    benchmark::DoNotOptimize(a.data());
    return watch.elapsed();
}

Elapsed time_flops(int threads)
{
    const Stopwatch watch;
    with_team(threads, [](const Team&) { compute(); });
    return watch.elapsed();
}

void Limits::look()
{
    ++looks_;
    flops_time_ += time_flops(threads_);
    if (with_memory_)
        triad_time_ += time_triad(threads_);
}

double Limits::flops() const
{
    return looks_ * flops_each * threads_ / flops_time_.wall;
}

void Limits::report_operations(benchmark::State& bench, double points, const Elapsed& time) const
{
    bench.counters["flops_per_second"] = flops();
    bench.counters["machine_operations_per_point"] = flops() * time.wall / points;
    if (threads_ == 1)
        bench.counters["cpu_operations_per_point"] = looks_ * flops_each / flops_time_.processor * time.processor / points;
}

void Limits::report_roofline(benchmark::State& bench, double points, const Elapsed& time) const
{
    double roof = flops() / operations_a_point;
    if (with_memory_)
    {
        const double bytes = looks_ * triad_bytes / triad_time_.wall;
        bench.counters["bytes_per_second"] = bytes;
        roof = std::min(roof, bytes / bytes_a_point);
    }
    bench.counters["roofline_share"] = points / time.wall / roof;
}
}  // namespace hdem::perf
