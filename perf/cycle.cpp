/// Whole cycles: cycle/<scene>/<blocks>/<method>/<threads>.

#include "core/state/state_hash.h"
#include "perf/counters.h"
#include "perf/limits.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>

namespace hdem::perf
{
namespace
{
void run_cycles(benchmark::State& bench, const std::string& scene, Index blocks, Method method, const std::string& family,
                int threads)
{
    static_cast<void>(settled_run(scene, blocks, method, threads));  // generated before memory is looked at
    const std::int64_t resident = resident_bytes();
    Simulation run = settled_run(scene, blocks, method, threads);
    const std::int64_t cycles = measured_cycles(blocks);
    run.advance(cycles / 5 + 1);
    const double bytes = static_cast<double>(resident_bytes() - resident);
    const std::int64_t before = run.contact_point_updates();
    Limits limits(threads, blocks >= blocks_beyond_caches);
    Elapsed time;
    for (auto _ : bench)
    {
        for (std::int64_t piece = 0; piece < pieces; ++piece)
        {
            limits.look();
            const Stopwatch watch;
            run.advance(cycles * (piece + 1) / pieces - cycles * piece / pieces);
            time += watch.elapsed();
        }
        bench.SetIterationTime(time.wall);
    }
    const auto updates = static_cast<double>(run.contact_point_updates() - before);
    report_points(bench, updates);
    limits.report_operations(bench, updates, time);
    limits.report_roofline(bench, updates, time);
    bench.counters["contact_points"] = static_cast<double>(run.count_contacts().closed());
    bench.counters["blocks"] = static_cast<double>(run.model().blocks());
    if (blocks >= 100'000)  // below, freed memory is used again, and pages are too coarse a measure
        bench.counters["bytes_per_block"] = bytes / run.model().blocks();
    bench.counters["broad_phases"] = static_cast<double>(run.state().broad_phase_runs);
    bench.counters["feature_searches"] = static_cast<double>(run.state().feature_searches);
    report_hash(bench, family, state_hash(run.model(), run.state()));
}

[[maybe_unused]] const bool registered = []
{
    const auto add = [](const std::string& scene, Index blocks, const NamedMethod& method, int threads)
    {
        const std::string family = "cycle/" + scene + '/' + std::to_string(blocks) + '/' + method.name;
        benchmark::RegisterBenchmark((family + '/' + std::to_string(threads)).c_str(), [=](benchmark::State& bench)
                                     { run_cycles(bench, scene, blocks, method.method, family, threads); })
            ->UseManualTime()
            ->Iterations(1)  // all runs of a scene end in the same state
            ->Unit(benchmark::kMillisecond);
    };
    for (const char* scene : named_scenes)
    {
        for (const Index blocks : {1'000, 10'000, 100'000, 1'000'000})
            for (const NamedMethod& method : named_methods)
                for (const int threads : thread_counts())
                    add(scene, blocks, method, threads);
        for (const Index each : {10'000, 100'000})  // weak scaling: so many for each thread
            for (const NamedMethod& method : named_methods)
                for (const int threads : thread_counts())
                    if (threads > 1)
                        add(scene, each * threads, method, threads);
    }
    for (const char* scene : other_scenes)
        for (const Index blocks : {1'000, 10'000, 100'000})
            for (const NamedMethod& method : named_methods)
                for (const int threads : thread_counts())
                    add(scene, blocks, method, threads);
    return true;
}();
}  // namespace
}  // namespace hdem::perf
