#include "parallel/impulse_sweeps.h"

#include "core/contact/impulse_forces.h"
#include "core/contact/impulse_law.h"
#include "core/contact/position_correction.h"
#include "core/motion/integrator.h"
#include "parallel/openmp.h"

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
}  // namespace

void apply_impulses(const Model& model, State& state, const Team& team, Index impulses, Partition& partition, Workspace& work)
{
    const bool together = impulses >= impulses_worth_sharing;
    Blocks& blocks = state.blocks;
    const IndexRange contact_parts = team.share(static_cast<Index>(partition.contacts.size()));
    for (Index i = contact_parts.begin; i < contact_parts.end; ++i)
        aim_impulses(model, blocks, partition.contacts[i].impulses);
    team.barrier();
    for_colours(team, together, partition,
                [&](ContactPart& part) { part.ledger.impulse_loss += start_impulses(part.impulses, blocks); });
    for (int sweep = 0; sweep < model.contact.impulse_sweeps; ++sweep)
        for_colours(team, together, partition,
                    [&](ContactPart& part)
                    {
                        part.ledger.impulse_loss += sweep_impulses(part.impulses, blocks);  // Eqs. (15)-(18)
                        sweep_correction(model, blocks, part.impulses, work.pseudo);        // Eq. (19)
                    });
    team.barrier();
    const IndexRange block_parts = team.share(static_cast<Index>(partition.blocks.size()));
    for (Index i = block_parts.begin; i < block_parts.end; ++i)
        add_correction_gravity(partition.blocks[i].range, model, blocks, work.pseudo, partition.blocks[i].ledger);
    for (Index i = contact_parts.begin; i < contact_parts.end; ++i)
    {
        ContactPart& part = partition.contacts[i];
        add_correction_springs(part.range, model, blocks, state.contacts, work.pseudo, part.ledger);
        add_impulse_work(model, part.impulses, blocks, part.ledger);
        store_impulses(model, part.impulses, state.contacts);  // Eqs. (29), (30)
    }
    team.barrier();
    if (team.is_first())
        for (const ContactPart& part : partition.contacts)
            add_impulse_forces(model, part.impulses, blocks.force);
}
}  // namespace hdem
