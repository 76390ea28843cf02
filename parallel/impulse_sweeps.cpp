#include "parallel/impulse_sweeps.h"

#include "core/contact/impulse_forces.h"
#include "core/contact/impulse_islands.h"
#include "core/contact/impulse_law.h"
#include "core/contact/position_correction.h"
#include "core/motion/integrator.h"
#include "parallel/team.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Impulse points from which colours are shared out; fewer are swept by one thread, in the same order.
constexpr Index impulses_worth_sharing = 2000;

template <typename Stage>
void for_colours(const Team& team, bool together, Partition& partition, const Stage& stage)
{
    for (const std::vector<Index>& colour : partition.colours)
    {
        const IndexRange mine = together ? team.share(static_cast<Index>(colour.size()))
                                         : IndexRange{0, static_cast<Index>(colour.size())};
        for (Index i = mine.begin; (together || team.is_first()) && i < mine.end; ++i)
            if (ContactPart& part = partition.contacts[colour[i]]; !part.impulses.empty())
                stage(part);
        if (together)
            team.barrier();
    }
}

std::vector<std::vector<ImpulsePoint>*> impulse_lists(Partition& partition)
{
    std::vector<std::vector<ImpulsePoint>*> lists;
    for (ContactPart& part : partition.contacts)
        lists.push_back(&part.impulses);
    return lists;
}

/// Islands that sweeps do not bring to an end, and those that are hit, each by one thread. Which these are does not depend on the number of threads.
void solve_islands(const Model& model, ExactIslands which, State& state, const Team& team, Partition& partition, Workspace& work)
{
    Blocks& blocks = state.blocks;
    MassRange masses;
    bool is_hit = false;
    for (const ContactPart& part : partition.contacts)
        if (!part.impulses.empty())
        {
            masses.add(part.masses);
            is_hit = is_hit || part.is_hit;
        }
    if (which == ExactIslands::hit && !is_hit)
        which = ExactIslands::small;
    if (which == ExactIslands::great_mass_ratios && masses.suits_sweeps(model.contact.impulse_sweeps))
        return;
    const IndexRange parts = team.share(static_cast<Index>(partition.contacts.size()));
    for (Index i = parts.begin; i < parts.end; ++i)
        partition.contacts[i].unsolved = are_unsolved(model, which, masses, partition.contacts[i].impulses, blocks, work.pseudo);
    team.barrier();
    if ((!is_hit || which == ExactIslands::great_mass_ratios) &&
        std::none_of(partition.contacts.begin(), partition.contacts.end(), [](const ContactPart& part) { return part.unsolved; }))
        return;
    team.alone([&] { partition.island_finder.find(impulse_lists(partition), blocks, partition.islands); });
    const IndexRange islands = team.share(static_cast<Index>(partition.islands.size()));
    for (Index i = islands.begin; i < islands.end; ++i)
        solve_island(model, which, blocks, work.pseudo, partition.islands[i]);
    team.barrier();
    if (team.is_first())
        for (const Island& island : partition.islands)
            state.ledger.impulse_loss += island.loss;
}
}  // namespace

void apply_impulses(const Model& model, ExactIslands exact, State& state, const Team& team, Index impulses, Partition& partition,
                    Workspace& work)
{
    const bool together = impulses >= impulses_worth_sharing;
    Blocks& blocks = state.blocks;
    const IndexRange contact_parts = team.share(static_cast<Index>(partition.contacts.size()));
    for (Index i = contact_parts.begin; i < contact_parts.end; ++i)
    {
        ContactPart& part = partition.contacts[i];
        aim_impulses(blocks, part.impulses);
        part.masses = mass_range(part.impulses, blocks);
        part.is_hit = std::any_of(part.impulses.begin(), part.impulses.end(), is_impact);
    }
    team.barrier();
    if (model.insitu.given)
        team.alone([&] { state.ledger.impulse_loss += start_impulses(impulse_lists(partition), true, blocks); });
    else
        for_colours(team, together, partition,
                    [&](ContactPart& part) { part.ledger.impulse_loss += start_impulses({&part.impulses}, false, blocks); });
    for (int sweep = 0; sweep < model.contact.impulse_sweeps; ++sweep)
        for_colours(team, together, partition,
                    [&](ContactPart& part)
                    {
                        part.ledger.impulse_loss += sweep_impulses(part.impulses, blocks);  // Eqs. (15)-(18)
                        sweep_correction(model, blocks, part.impulses, work.pseudo);        // Eq. (19)
                    });
    team.barrier();
    solve_islands(model, exact, state, team, partition, work);
    const IndexRange block_parts = team.share(static_cast<Index>(partition.blocks.size()));
    for (Index i = block_parts.begin; i < block_parts.end; ++i)
        add_correction_gravity(partition.blocks[i].range, model, blocks, work.pseudo, partition.blocks[i].ledger);
    for (Index i = contact_parts.begin; i < contact_parts.end; ++i)
    {
        ContactPart& part = partition.contacts[i];
        add_correction_springs(part.range, blocks, state.contacts, work.pseudo, part.ledger);
        count_from_zero(part.impulses);
        add_impulse_work(model, part.impulses, blocks, part.ledger);
        store_impulses(model, blocks, part.impulses, state.contacts);  // Eqs. (29), (30)
    }
    team.barrier();
    if (team.is_first())
        for (const ContactPart& part : partition.contacts)
            add_impulse_forces(part.impulses, blocks);
}
}  // namespace hdem
