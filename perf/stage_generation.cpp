/// From joints and outlines to a model: stage/generation. An item is a block.

#include "core/rock/build_model.h"
#include "core/state/state_hash.h"
#include "perf/stage.h"

#include <optional>

namespace hdem::perf
{
namespace
{
void run(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const CaseDef def = make_scene(scene, blocks, Method::hybrid);
    const double made = build_model(def).model.blocks();
    time_stage(
        bench, family, made, [] { return std::optional<Setup>(); }, [&](std::optional<Setup>& setup) { setup = build_model(def); },
        [](const std::optional<Setup>& setup) { return model_hash(setup->model); });
}

[[maybe_unused]] const bool registered = (register_stage("generation", run), true);
}  // namespace
}  // namespace hdem::perf
