/// Springs of all contacts and their sums block by block: stage/force_law. An item is a contact.

#include "core/state/state_hash.h"
#include "perf/stage.h"

namespace hdem::perf
{
namespace
{
void run(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const Simulation settled = settled_run(scene, blocks, Method::force, 1);
    if (matches_cycle(bench, settled))
        time_stage(
            bench, family, settled.state().contacts.size(), [&] { return StageScratch(settled.state()); },
            [&](StageScratch& scratch) { evaluate(settled.model(), scratch); },
            [&](const StageScratch& scratch) { return state_hash(settled.model(), scratch.state); });
}

[[maybe_unused]] const bool registered = (register_stage("force_law", run), true);
}  // namespace
}  // namespace hdem::perf
