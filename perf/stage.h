#pragma once
/// One stage of a cycle by itself, on one thread and always on the same state: stage/<stage>/<scene>/<blocks>.

#include "perf/counters.h"
#include "perf/limits.h"
#include "perf/scene_run.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>

namespace hdem::perf
{
/// Register a stage for the scenes wall, voronoi and joints of 1 000 to 100 000 blocks.
void register_stage(
    const std::string& stage,
    const std::function<void(benchmark::State&, const std::string& scene, Index blocks, const std::string& family)>& run);

/// Time `work` on scratch that `prepare` makes anew each time. ns_per_item is the fastest time over `items` (contacts, points, blocks, pairs). The
/// benchmark is an error if `hash` of the result is not the same each time.
template <typename Prepare, typename Work, typename Hash>
void time_stage(benchmark::State& bench, const std::string& family, double items, const Prepare& prepare, const Work& work,
                const Hash& hash)
{
    double least = std::numeric_limits<double>::infinity();
    for (auto _ : bench)
    {
        auto scratch = prepare();
        const Stopwatch watch;
        work(scratch);
        const double passed = watch.elapsed().wall;
        bench.SetIterationTime(passed);
        least = std::min(least, passed);
        report_hash(bench, family, hash(scratch));
    }
    bench.counters["items"] = items;
    bench.counters["ns_per_item"] = 1e9 * least / items;
}

/// FNV-1a, eight bytes at a time.
template <typename Values>
[[nodiscard]] std::uint64_t hash_of(const Values& values, std::uint64_t seed = 0)
{
    std::uint64_t hash = 14695981039346656037u ^ seed;
    for (const auto value : values)
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
    return hash;
}

/// What a stage reads and writes.
struct StageScratch
{
    State state;
    ContactLoads loads;
    BlockContacts block_contacts;

    explicit StageScratch(const State& from);
    [[nodiscard]] IndexRange all_contacts() const { return {0, state.contacts.size()}; }
    [[nodiscard]] IndexRange all_blocks() const { return {0, state.blocks.size()}; }
};

/// The stages of a cycle without impulses, one after another; some or all.
void evaluate(const Model& model, StageScratch& scratch);
void move(const Model& model, StageScratch& scratch);

/// Do these give the state that a cycle of hdem gives? If not, the benchmark becomes an error.
bool matches_cycle(benchmark::State& bench, const Simulation& run);
}  // namespace hdem::perf
