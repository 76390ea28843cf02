/// A thousand cycles for callgrind: counted/<scene>/<method>. perf/gate reads how many instructions `hdem_counted_cycles` takes.

#include "core/rock/build_model.h"
#include "core/state/state_hash.h"
#include "perf/counters.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>

#include <random>

/// Its name is given to callgrind: nothing else is counted.
extern "C" [[gnu::noinline]] void hdem_counted_cycles(hdem::Simulation& run)
{
    run.advance(1000);
}

namespace hdem::perf
{
namespace
{
constexpr Index blocks = 225;
constexpr Index thrown_blocks = 900;

/// Loose blocks thrown at each other at a few metres a second.
Simulation thrown_pile(Method method)
{
    CaseDef def = scenes::pile(thrown_blocks, 30);
    def.contact.method = method;
    std::mt19937_64 engine(1);
    const auto speed = [&] { return 8.0 * (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5); };
    for (BlockDef& block : def.blocks)
        if (block.name.starts_with("block"))
        {
            block.velocity.x() = speed();
            block.velocity.y() = speed();
        }
    Setup built = build_model(def);
    return {std::move(built.model), std::move(built.state), 1};
}

void count(benchmark::State& bench, const std::string& scene, Method method, const std::string& family)
{
    Simulation run = scene == "pile" ? thrown_pile(method) : settled_run(scene, blocks, method, 1);
    for (auto _ : bench)
        hdem_counted_cycles(run);
    bench.counters["closed_points"] = static_cast<double>(run.contact_point_updates());
    bench.counters["broad_phases"] = static_cast<double>(run.state().broad_phase_runs);
    bench.counters["feature_searches"] = static_cast<double>(run.state().feature_searches);
    report_hash(bench, family, state_hash(run.model(), run.state()));
}

[[maybe_unused]] const bool registered = []
{
    struct Counted
    {
        const char* scene;
        const char* method_name;
        Method method;
    };
    for (const Counted& c : {Counted{"wall", "force", Method::force}, Counted{"voronoi", "hybrid", Method::hybrid},
                             Counted{"joints", "impulse", Method::impulse}, Counted{"pile", "hybrid", Method::hybrid}})
    {
        const std::string family = std::string("counted/") + c.scene + '/' + c.method_name;
        benchmark::RegisterBenchmark(family.c_str(), [=](benchmark::State& bench) { count(bench, c.scene, c.method, family); })
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();
}  // namespace
}  // namespace hdem::perf
