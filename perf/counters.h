#pragma once
/// What every benchmark prints beside its time.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

namespace hdem::perf
{
/// The machine is looked at between pieces of a measurement.
inline constexpr std::int64_t pieces = 10;

/// Cycles of a measurement. No piece is so short that what a call of run() costs beyond its cycles shows: runs make such calls at their looks only.
[[nodiscard]] constexpr std::int64_t measured_cycles(std::int64_t blocks)
{
    constexpr std::int64_t least = 200, block_cycles = 4'000'000;
    return blocks * least < block_cycles ? block_cycles / blocks : least;
}

/// contact_point_updates_per_second and ns_per_contact_point, of `points` in all the time that was counted.
void report_points(benchmark::State& bench, double points);

/// The result's hash as a counter, 53 bits of it. All benchmarks of a `family` (a scene and a method on any number of threads, again and again) must
/// end with the same: one that does not becomes an error, and its speed is not printed.
void report_hash(benchmark::State& bench, const std::string& family, std::uint64_t hash);
}  // namespace hdem::perf
