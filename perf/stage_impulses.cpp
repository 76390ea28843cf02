/// One sweep over all impulse points, with its position correction: stage/impulse_sweep. An item is a point.

#include "core/contact/contact_forces.h"
#include "core/contact/impulse_law.h"
#include "core/contact/position_correction.h"
#include "perf/stage.h"

namespace hdem::perf
{
namespace
{
struct Scratch
{
    Blocks blocks;
    std::vector<ImpulsePoint> points;
    std::vector<Triple> pseudo;
};

void sweep(const Model& model, Scratch& scratch)
{
    benchmark::DoNotOptimize(sweep_impulses(scratch.points, scratch.blocks));
    sweep_correction(model, scratch.blocks, scratch.points, scratch.pseudo);
}

/// Impulses must press, and no more than the joints carry: the law's own bounds, for each point.
bool are_admissible(const std::vector<ImpulsePoint>& points)
{
    for (const ImpulsePoint& p : points)
        if (!(p.impulse_normal >= 0.0) ||
            !(std::abs(p.impulse_shear) <= (p.impulse_normal * p.friction + p.cohesive_impulse) * (1.0 + 1e-9) + 1e-12))
            return false;
    return true;
}

void run(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const Simulation settled = settled_run(scene, blocks, Method::impulse, 1);
    const Model& model = settled.model();
    StageScratch evaluated(settled.state());
    evaluate(model, evaluated);
    Scratch begin{evaluated.state.blocks, {}, std::vector<Triple>(static_cast<std::size_t>(model.blocks()))};
    collect_impulse_points(evaluated.all_contacts(), model, begin.blocks, evaluated.state.contacts, begin.points);
    aim_impulses(begin.blocks, begin.points);
    start_impulses({&begin.points}, false, begin.blocks);
    Scratch swept = begin;
    sweep(model, swept);
    if (begin.points.empty() || !are_admissible(swept.points))
        return bench.SkipWithError("impulses pull, or hold more than their joint carries");
    time_stage(
        bench, family, static_cast<double>(begin.points.size()), [&] { return begin; },
        [&](Scratch& scratch) { sweep(model, scratch); },
        [](const Scratch& scratch)
        {
            std::uint64_t hash = 0;
            for (const ImpulsePoint& p : scratch.points)
                hash = hash_of(std::array{p.impulse_normal, p.impulse_shear}, hash);
            return hash;
        });
}

[[maybe_unused]] const bool registered = (register_stage("impulse_sweep", run), true);
}  // namespace
}  // namespace hdem::perf
