/// The fingerprint of a state: stage/state_hash. An item is a block. It is taken at the end of a run and beside each measured speed, never within a cycle.

#include "core/state/state_hash.h"
#include "perf/stage.h"

namespace hdem::perf
{
namespace
{
void run(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const Simulation settled = settled_run(scene, blocks, Method::force, 1);
    time_stage(
        bench, family, settled.model().blocks(), [] { return std::uint64_t{0}; },
        [&](std::uint64_t& hash) { hash = state_hash(settled.model(), settled.state()); },
        [](const std::uint64_t& hash) { return hash; });
}

[[maybe_unused]] const bool registered = (register_stage("state_hash", run), true);
}  // namespace
}  // namespace hdem::perf
