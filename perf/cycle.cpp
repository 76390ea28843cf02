/// Whole cycles: cycle/<scene>/<blocks>/<method>/<threads>.

#include "core/state/state_hash.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>

#include <chrono>

namespace hdem::perf
{
namespace
{
void run_cycles(benchmark::State& bench, const std::string& scene, Index blocks, Method method, int threads)
{
    static_cast<void>(settled_run(scene, blocks, method, threads));  // generated before memory is looked at
    const std::int64_t resident = resident_bytes();
    Simulation run = settled_run(scene, blocks, method, threads);
    const auto cycles = std::max<std::int64_t>(5, 4'000'000 / blocks);
    run.advance(cycles / 5 + 1);
    const std::int64_t before = run.contact_point_updates();
    for (auto _ : bench)
    {
        const auto begin = std::chrono::steady_clock::now();
        run.advance(cycles);
        bench.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    const auto updates = static_cast<double>(run.contact_point_updates() - before);
    bench.counters["contact_point_updates_per_second"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
    bench.counters["ns_per_contact_point"] = benchmark::Counter(1e-9 * updates,
                                                                benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    bench.counters["contact_points"] = static_cast<double>(run.count_contacts().closed());
    bench.counters["blocks"] = static_cast<double>(run.model().blocks());
    if (blocks >= 100'000)  // below, freed memory is used again, and pages are too coarse a measure
        bench.counters["bytes_per_block"] = static_cast<double>(resident_bytes() - resident) / run.model().blocks();
    bench.counters["broad_phases"] = static_cast<double>(run.state().broad_phase_runs);
    bench.counters["feature_searches"] = static_cast<double>(run.state().feature_searches);
    // A counter is a double: 53 bits of the hash, which all runs of a name must share.
    bench.counters["state_hash"] = static_cast<double>(state_hash(run.model(), run.state()) >> 11);
}

[[maybe_unused]] const bool registered = []
{
    struct Named
    {
        const char* name;
        Method method;
    };
    for (const char* scene : {"wall", "voronoi", "joints"})
        for (const Index blocks : {1'000, 10'000, 100'000, 1'000'000})
            for (const Named& method : {Named{"force", Method::force}, Named{"hybrid", Method::hybrid}})
                for (const int threads : {1, 2})
                    benchmark::RegisterBenchmark(("cycle/" + std::string(scene) + "/" + std::to_string(blocks) + "/" + method.name +
                                                  "/" + std::to_string(threads))
                                                     .c_str(),
                                                 [=](benchmark::State& bench)
                                                 { run_cycles(bench, scene, blocks, method.method, threads); })
                        ->UseManualTime()
                        ->Iterations(1)  // all runs of a scene end in the same state
                        ->Unit(benchmark::kMillisecond);
    return true;
}();
}  // namespace
}  // namespace hdem::perf
