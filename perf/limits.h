#pragma once
/// What the machine can do at this moment: the roofline that a speed is compared with.

#include "core/types.h"

#include <benchmark/benchmark.h>

namespace hdem::perf
{
/// Seconds for `triad_bytes` of STREAM's triad a = b + s c (McCalpin 1995), counted as there: two arrays read, one written. 384 MB, far beyond any cache.
double time_triad(int threads);
inline constexpr Index triad_size = 16'000'000;
inline constexpr double triad_bytes = 24.0 * triad_size;

/// Seconds for `flops_each` independent multiplications and additions on registers, per thread. Without fused multiply-add, which the laws do without too.
double time_flops(int threads);
inline constexpr int flops_rounds = 500'000;
inline constexpr int flops_chains = 8;
inline constexpr double flops_each = 2.0 * 4 * flops_chains * flops_rounds;

/// What a closed point needs in a cycle, counted from the source (perf/README.md): double operations, and bytes from memory where nothing stays in a cache.
inline constexpr double operations_a_point = 170.0;
inline constexpr double bytes_a_point = 310.0;
/// Blocks from which it does not.
inline constexpr Index blocks_beyond_caches = 100'000;

/// Looks at the machine again and again between pieces of a measurement: what slows the one down on a shared machine slows the other.
class Limits
{
  public:
    /// `with_memory`: the triad too; it empties the caches.
    Limits(int threads, bool with_memory) : threads_(threads), with_memory_(with_memory) {}

    void look();

    /// flops_per_second of the machine, and machine_operations_per_point: the double operations that it could have done in the time of one of
    /// `points` in `seconds`. That figure stays when the machine as a whole is slower.
    void report_operations(benchmark::State& bench, double points, double seconds) const;
    /// roofline_share of the speed that operations and, with memory, bytes_per_second allow. For closed points through cycles of hdem.
    void report_roofline(benchmark::State& bench, double points, double seconds) const;

  private:
    [[nodiscard]] double flops() const;

    int threads_;
    bool with_memory_;
    int looks_ = 0;
    double flops_seconds_ = 0.0;
    double triad_seconds_ = 0.0;
};
}  // namespace hdem::perf
