/// Boxes, cells, pairs: stage/broad_phase. An item is a pair.

#include "core/detection/contact_tracking.h"
#include "perf/stage.h"

#include <algorithm>

namespace hdem::perf
{
namespace
{
struct Scratch
{
    std::vector<Box> boxes;
    std::vector<std::uint64_t> pairs;
};

void find(const Model& model, const Blocks& blocks, Scratch& scratch)
{
    compute_boxes({0, model.shapes.parts()}, model, blocks, scratch.boxes);
    CellList cells;
    cells.build(scratch.boxes);
    cells.find_pairs({0, model.shapes.parts()}, scratch.pairs);
}

/// All pairs that are contacts now?
bool holds_contacts(const Scratch& scratch, const Contacts& contacts)
{
    std::vector<std::uint64_t> sorted = scratch.pairs;
    std::sort(sorted.begin(), sorted.end());
    for (Index i = 0; i < contacts.size(); ++i)
        if (!std::binary_search(sorted.begin(), sorted.end(), pair_key(contacts.part_a[i], contacts.part_b[i])))
            return false;
    return true;
}

void run(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const Simulation settled = settled_run(scene, blocks, Method::force, 1);
    const Model& model = settled.model();
    const auto prepare = [&]
    {
        Scratch scratch;
        scratch.boxes.resize(static_cast<std::size_t>(model.shapes.parts()));
        return scratch;
    };
    Scratch first = prepare();
    find(model, settled.state().blocks, first);
    if (!holds_contacts(first, settled.state().contacts))
        return bench.SkipWithError("misses pairs that are contacts");
    time_stage(
        bench, family, static_cast<double>(first.pairs.size()), prepare,
        [&](Scratch& scratch) { find(model, settled.state().blocks, scratch); },
        [](const Scratch& scratch) { return hash_of(scratch.pairs); });
}

[[maybe_unused]] const bool registered = (register_stage("broad_phase", run), true);
}  // namespace
}  // namespace hdem::perf
