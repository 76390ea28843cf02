#pragma once
/// What the machine can do at this moment: the roofline that a speed is compared with.

#include "core/types.h"

#include <benchmark/benchmark.h>

namespace hdem::perf
{
/// How long something took: by the clock, and on processors, all threads together. On one thread the second does not count the time that others had.
struct Elapsed
{
    double wall = 0.0;       ///< [s]
    double processor = 0.0;  ///< [s]
    Elapsed& operator+=(const Elapsed& other);
};

/// Runs from its making on.
class Stopwatch
{
  public:
    Stopwatch();
    [[nodiscard]] Elapsed elapsed() const;

  private:
    Elapsed begin_;
};

/// STREAM's triad a = b + s c (McCalpin 1995), `triad_bytes` counted as there: two arrays read, one written. 384 MB, far beyond any cache.
Elapsed time_triad(int threads);
inline constexpr Index triad_size = 16'000'000;
inline constexpr double triad_bytes = 24.0 * triad_size;

/// `flops_each` independent multiplications and additions on registers, per thread. Without fused multiply-add, which the laws do without too.
Elapsed time_flops(int threads);
inline constexpr int flops_rounds = 500'000;
inline constexpr int flops_chains = 8;
inline constexpr double flops_each = 2.0 * 4 * flops_chains * flops_rounds;

/// What a closed point needs in a cycle, counted from the source (perf/README.md): double operations, and bytes from memory where nothing stays in a cache.
inline constexpr double operations_a_point = 170.0;
inline constexpr double bytes_a_point = 310.0;
/// Number of blocks from which on nothing stays in a cache.
inline constexpr Index blocks_beyond_caches = 100'000;

/// Measures the machine again and again between pieces of a measurement, so that other work on a shared machine slows both alike.
class Limits
{
  public:
    /// `with_memory`: the triad too; it empties the caches.
    Limits(int threads, bool with_memory) : threads_(threads), with_memory_(with_memory) {}

    void look();

    /// flops_per_second of the machine, and machine_operations_per_point: the double operations that it could have done in the time of one of
    /// `points`. On one thread also cpu_operations_per_point, both by processor time: what else runs on the machine counts least in that.
    void report_operations(benchmark::State& bench, double points, const Elapsed& time) const;
    /// roofline_share of the speed that operations and, with memory, bytes_per_second allow. For closed points through cycles of hdem.
    void report_roofline(benchmark::State& bench, double points, const Elapsed& time) const;

  private:
    [[nodiscard]] double flops() const;

    int threads_;
    bool with_memory_;
    int looks_ = 0;
    Elapsed flops_time_;
    Elapsed triad_time_;
};
}  // namespace hdem::perf
