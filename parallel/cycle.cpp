#include "parallel/cycle.h"

#include "core/contact/contact_forces.h"
#include "core/contact/impulse_law.h"
#include "core/detection/contact_tracking.h"
#include "core/motion/integrator.h"
#include "parallel/openmp.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Contacts a thread takes at once. Below two chunks the cycle stays on one thread: sharing out costs more than it saves.
constexpr Index contact_chunk = 2048;
}  // namespace

void rebuild_contacts(const Model& model, State& state, BroadPhase& broad)
{
    const IndexRange parts{0, model.shapes.parts()};
    broad.boxes.resize(static_cast<std::size_t>(parts.end));
    compute_boxes(parts, model, state.blocks, broad.boxes);
    broad.cells.build(broad.boxes);
    broad.pairs.clear();
    broad.cells.find_pairs(parts, broad.pairs);
    std::sort(broad.pairs.begin(), broad.pairs.end());
    broad.tracked.clear();
    track_contacts({0, static_cast<Index>(broad.pairs.size())}, broad.pairs, model, state.blocks, state.contacts, broad.tracked,
                   state.ledger);
    const auto n = static_cast<Index>(broad.tracked.size());
    state.contacts.resize(n);
    for (Index i = 0; i < n; ++i)
        state.contacts.put(i, broad.tracked[i]);
    state.rebuilt_at = state.blocks.motion;
    state.contacts_outdated = false;
    ++state.broad_phase_runs;
}

void run_cycle(const Model& model, State& state, Workspace& work, BroadPhase& broad, int threads)
{
    Blocks& blocks = state.blocks;
    const IndexRange all_blocks{0, blocks.size()};
    if (state.contacts_outdated || has_outrun_skin(all_blocks, model, blocks, state.rebuilt_at))
        rebuild_contacts(model, state, broad);
    Contacts& contacts = state.contacts;
    const IndexRange all_contacts{0, contacts.size()};
    work.loads.resize(static_cast<std::size_t>(contacts.size()));
    work.pseudo.resize(static_cast<std::size_t>(blocks.size()));

    state.feature_searches += refresh_features(all_contacts, model, blocks, contacts, state.ledger);
    prescribe_motions(model, state.cycle, contacts, blocks, state.ledger);
    apply_weights(all_blocks, model, blocks);
    apply_loads(model, state.cycle, blocks, work.loaded);
    for_ranges(all_contacts, contact_chunk, threads,  // Eqs. (1)-(10), (24)-(28)
               [&](IndexRange range) { evaluate_contacts(range, model, state.method, blocks, contacts, work.loads); });
    accumulate_loads(all_contacts, contacts, work.loads, blocks.force, state.ledger);
    work.impulses.clear();
    if (state.method != Method::force)
        collect_impulse_points(all_contacts, model, blocks, contacts, work.impulses);
    update_velocities(all_blocks, model, state.damping, blocks, state.ledger);  // Eqs. (11)-(14), (20)-(22)

    if (!work.impulses.empty())
    {
        const IndexRange all_impulses{0, static_cast<Index>(work.impulses.size())};
        state.ledger.impulse_loss += start_impulses(all_impulses, work.impulses, blocks);
        for (int sweep = 0; sweep < model.contact.impulse_sweeps; ++sweep)
        {
            state.ledger.impulse_loss += sweep_impulses(all_impulses, work.impulses, blocks);  // Eqs. (15)-(18)
            sweep_correction(all_impulses, model, blocks, work.impulses, work.pseudo);         // Eq. (19)
        }
        add_correction_work(model, blocks, contacts, work.pseudo, state.ledger);
        add_impulse_work(all_impulses, model, work.impulses, blocks, state.ledger);
        store_impulses(all_impulses, model, work.impulses, contacts, blocks.force);  // Eqs. (29), (30)
    }
    add_load_work(model, state.cycle, blocks, work.loaded, state.ledger);
    update_positions(all_blocks, model.time_step, blocks, work.pseudo);
    ++state.cycle;
    state.time = static_cast<double>(state.cycle) * model.time_step;
}
}  // namespace hdem
