#include "perf/stage.h"

#include "core/contact/block_forces.h"
#include "core/contact/contact_forces.h"
#include "core/detection/contact_tracking.h"
#include "core/motion/integrator.h"
#include "core/stage/rules.h"
#include "core/state/state_hash.h"

namespace hdem::perf
{
void register_stage(const std::string& stage,
                    const std::function<void(benchmark::State&, const std::string&, Index, const std::string&)>& run)
{
    for (const char* scene : {"wall", "voronoi", "joints"})
        for (const Index blocks : {1'000, 10'000, 100'000})
        {
            const std::string family = "stage/" + stage + '/' + scene + '/' + std::to_string(blocks);
            benchmark::RegisterBenchmark(family.c_str(), [=](benchmark::State& bench) { run(bench, scene, blocks, family); })
                ->UseManualTime()
                ->Iterations(10)  // each begins with a copy that is not timed and takes longer than the stage
                ->Unit(benchmark::kMillisecond);
        }
}

StageScratch::StageScratch(const State& from) : state(from)
{
    loads.resize(state.contacts.stale.size());
    list_block_contacts(state.contacts, state.blocks.size(), block_contacts);
}

void evaluate(const Model& model, StageScratch& scratch)
{
    const StageRules rules = resolve_rules(model, scratch.state);
    const ContactTally tally = evaluate_contacts(scratch.all_contacts(), model, rules.contact, scratch.state.blocks,
                                                 scratch.state.contacts, scratch.loads);
    benchmark::DoNotOptimize(tally.closed);
    sum_forces(scratch.all_blocks(), model, scratch.block_contacts, scratch.loads, {}, rules.damping.needs_joint(),
               scratch.state.blocks);
}

void move(const Model& model, StageScratch& scratch)
{
    VelocityWorks works;
    update_velocities(scratch.all_blocks(), model, resolve_rules(model, scratch.state).damping, scratch.state.blocks, works);
    works.add_to(scratch.state.ledger);
    benchmark::DoNotOptimize(update_positions(scratch.all_blocks(), model, scratch.state.blocks));
}

bool matches_cycle(benchmark::State& bench, const Simulation& run)
{
    if (!run.state().moving.empty())  // a cycle damps groups that move together otherwise; that is no stage of its own
        return true;
    StageScratch scratch(run.state());
    refresh_features(scratch.all_contacts(), run.model(), scratch.state.blocks, scratch.state.contacts, scratch.state.ledger);
    evaluate(run.model(), scratch);
    move(run.model(), scratch);
    Simulation cycle(run.model(), run.state(), 1);
    cycle.advance(1);
    // What a cycle does besides its stages: it counts, and the step that it has used becomes the last one.
    ++scratch.state.cycle;
    scratch.state.time += scratch.state.blocks.step.next;
    scratch.state.blocks.step.last = scratch.state.blocks.step.next;
    const bool same = state_hash(run.model(), scratch.state) == state_hash(run.model(), cycle.state());
    if (!same)
        bench.SkipWithError("the stages one by one give another state than a cycle");
    return same;
}
}  // namespace hdem::perf
