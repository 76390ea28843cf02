#include "parallel/step_update.h"

#include "parallel/team.h"

namespace hdem
{
void update_step(const Model& model, const StepRule& rule, State& state, const Team& team, std::int64_t now, bool renewed,
                 Partition& partition, const BlockContacts& list)
{
    const bool look_at_all = renewed || now % look_at_all_every == 0 || now == state.stage_begin_cycle;
    if (!look_at_all && !state.rest_changed && now % look_every != 0)
        return;
    const IndexRange mine = team.share(static_cast<Index>(partition.blocks.size()));
    for (Index i = mine.begin; i < mine.end; ++i)
    {
        BlockPart& part = partition.blocks[i];
        part.step = {};
        for (const IndexRange& range : part.active)
            part.step.add(bound_steps(range, rule, look_at_all, model, list, state.contacts, state.blocks));
    }
    team.barrier();
    StepBound bound;
    for (const BlockPart& part : partition.blocks)
        bound.add(part.step);
    const double next = next_step(state.blocks.step.last, bound, rule, model.time_step, now % grow_every == 0);
    const bool flies = flies_ahead(bound, rule, model.time_step);
    team.barrier();
    if (team.is_first())
    {
        state.blocks.step.next = next;
        state.flies_ahead = flies;
    }
    team.barrier();
}
}  // namespace hdem
