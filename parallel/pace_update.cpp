#include "parallel/pace_update.h"

#include "core/motion/pace.h"
#include "core/motion/time_step.h"
#include "parallel/openmp.h"

#include <algorithm>
#include <limits>

namespace hdem
{
namespace
{
template <typename Stage>
void for_parts(const Team& team, Partition& partition, const Stage& stage)
{
    const IndexRange mine = team.share(static_cast<Index>(partition.blocks.size()));
    for (Index i = mine.begin; i < mine.end; ++i)
        stage(partition.blocks[i]);
    team.barrier();
}

Paces next_paces(const Model& model, const State& state, const Partition& partition, std::int64_t now, bool look, bool look_at_all)
{
    Paces paces = state.pace;
    StandingRock standing;
    double bound = std::numeric_limits<double>::infinity();
    double step = std::numeric_limits<double>::infinity();
    for (const BlockPart& part : partition.blocks)
    {
        standing.kinetic_energy += part.standing.kinetic_energy;
        standing.free_mass += part.standing.free_mass;
        bound = std::min(bound, part.pace_bound);
        step = std::min(step, part.stable_step);
    }
    if (look)
    {
        // Of a part of the blocks no more is known than that they allow no more.
        const double pace = rock_pace(model, step);
        paces.rock = look_at_all ? pace : std::min(pace, paces.rock);
    }
    paces.loose = next_loose_pace(model, paces, standing, bound, now % pace_growth_every == 0);
    return paces;
}
}  // namespace

void update_paces(const Model& model, State& state, const Team& team, std::int64_t now, bool renewed, Partition& partition,
                  Workspace& work)
{
    const bool look_at_all = now % rock_pace_every == 0 || now == state.stage_begin_cycle;
    const bool look = model.has_own_step && (renewed || look_at_all);
    if (!renewed && !look_at_all && now % pace_every != 0)
        return;
    const Contacts& contacts = state.contacts;
    Blocks& blocks = state.blocks;
    for_parts(team, partition,
              [&](BlockPart& part)
              {
                  part.standing = bound_paces(part.range, model, work.block_contacts, contacts, blocks, work.pace_bounds);
                  if (look)
                      part.stable_step = stable_step(part.range, look_at_all ? StepOf::all : StepOf::fast, model,
                                                     work.block_contacts, contacts, blocks);
              });
    for_parts(team, partition,
              [&](BlockPart& part) {
                  part.pace_bound = join_bounds(part.range, model, work.block_contacts, contacts, blocks, work.pace_bounds,
                                                work.joint_bounds);
              });
    const Paces paces = next_paces(model, state, partition, now, look, look_at_all);
    for_parts(team, partition, [&](BlockPart& part) { set_paces(part.range, model, paces, work.joint_bounds, blocks); });
    if (team.is_first())
        state.pace = paces;
    team.barrier();
}
}  // namespace hdem
