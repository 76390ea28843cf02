/// Features searched anew (stage/narrow_full), and points on edges that are known (stage/narrow_recycled). An item is a contact.

#include "core/contact/contact_lanes.h"
#include "core/detection/contact_tracking.h"
#include "core/state/state_hash.h"
#include "perf/stage.h"

#include <algorithm>

namespace hdem::perf
{
namespace
{
void run_full(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const Simulation settled = settled_run(scene, blocks, Method::force, 1);
    const Model& model = settled.model();
    const auto prepare = [&]
    {
        StageScratch scratch(settled.state());
        std::fill_n(scratch.state.contacts.stale.begin(), scratch.state.contacts.size(), std::uint8_t{1});
        return scratch;
    };
    const auto hash = [&](const StageScratch& scratch) { return state_hash(model, scratch.state); };
    time_stage(
        bench, family, settled.state().contacts.size(), prepare,
        [&](StageScratch& scratch)
        {
            const Index searched = refresh_features(scratch.all_contacts(), model, scratch.state.blocks, scratch.state.contacts,
                                                    scratch.state.ledger);
            if (searched != scratch.state.contacts.size())
                bench.SkipWithError("did not search all contacts");
        },
        hash);
}

/// Overlaps of both ends of all contacts.
using Overlaps = std::vector<double>;

void touch_packs(const State& state, Overlaps& overlaps)
{
    const Contacts& contacts = state.contacts;
    for (std::size_t i = 0; i < contacts.lane.size(); ++i)
    {
        const BasicEdgePair<Pack> edges = load_edges<Pack>(contacts.lane[i]);
        const BasicMotion<Pack> ref = load_motions<Pack>(state.blocks.motion, &contacts.ref[lanes * i]);
        const BasicMotion<Pack> inc = load_motions<Pack>(state.blocks.motion, &contacts.inc[lanes * i]);
        const BasicEdgeTouch<Pack> touch = touch_edges(edges, ref, inc);
        touch.point[0].overlap.store(&overlaps[2 * lanes * i]);
        touch.point[1].overlap.store(&overlaps[2 * lanes * i + lanes]);
    }
}

/// Against one contact at a time.
bool is_exact(const State& state, const Overlaps& overlaps)
{
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        const BlockMotion& ref = state.blocks.motion[state.contacts.ref[i]];
        const BlockMotion& inc = state.blocks.motion[state.contacts.inc[i]];
        const EdgeTouch touch = touch_edges(state.contacts.edges(i), ref, inc);
        const std::size_t first = 2 * lanes * static_cast<std::size_t>(i / lanes) + static_cast<std::size_t>(i % lanes);
        if (overlaps[first] != touch.point[0].overlap || overlaps[first + lanes] != touch.point[1].overlap)
            return false;
    }
    return true;
}

void run_recycled(benchmark::State& bench, const std::string& scene, Index blocks, const std::string& family)
{
    const Simulation settled = settled_run(scene, blocks, Method::force, 1);
    const State& state = settled.state();
    const auto prepare = [&] { return Overlaps(2 * lanes * state.contacts.lane.size()); };
    Overlaps first = prepare();
    touch_packs(state, first);
    if (!is_exact(state, first))
        return bench.SkipWithError("four contacts at once give other overlaps than one at a time");
    time_stage(
        bench, family, state.contacts.size(), prepare, [&](Overlaps& overlaps) { touch_packs(state, overlaps); },
        [](const Overlaps& overlaps) { return hash_of(overlaps); });
}

[[maybe_unused]] const bool registered = (register_stage("narrow_full", run_full), register_stage("narrow_recycled", run_recycled),
                                          true);
}  // namespace
}  // namespace hdem::perf
