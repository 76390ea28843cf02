#pragma once
/// A scene brought to rest, ready to be timed.

#include "parallel/simulation.h"
#include "perf/bench_scenes.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace hdem::perf
{
struct NamedMethod
{
    const char* name;
    Method method;
};
inline constexpr std::array<NamedMethod, 3> named_methods{
    {{"force", Method::force}, {"impulse", Method::impulse}, {"hybrid", Method::hybrid}}};

/// 1, 2, 4, ... as far as the processors go, and 2 at least.
[[nodiscard]] std::vector<int> thread_counts();

/// The scene generated and settled under the force method with local damping, then switched to `method`. Kept for the next call, so that
/// interleaved repetitions on other thread counts do not generate it again.
[[nodiscard]] Simulation settled_run(const std::string& scene, Index blocks, Method method, int threads);

/// Bytes this process has in memory now, without what it has freed.
[[nodiscard]] std::int64_t resident_bytes();
}  // namespace hdem::perf
