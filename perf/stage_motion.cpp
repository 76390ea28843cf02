/// Velocities with damping, and poses: stage/motion. An item is a block.

#include "core/state/state_hash.h"
#include "perf/stage.h"

namespace hdem::perf
{
namespace
{
void run(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const Simulation settled = settled_run(scene, blocks, Method::force, 1);
    StageScratch evaluated(settled.state());
    evaluate(settled.model(), evaluated);
    if (matches_cycle(bench, settled))
        time_stage(
            bench, family, settled.model().blocks(), [&] { return evaluated; },
            [&](StageScratch& scratch) { move(settled.model(), scratch); },
            [&](const StageScratch& scratch) { return state_hash(settled.model(), scratch.state); });
}

[[maybe_unused]] const bool registered = (register_stage("motion", run), true);
}  // namespace
}  // namespace hdem::perf
