#include "core/support/installed_support.h"

#include "core/support/bolt_link.h"
#include "core/support/bolt_memory.h"
#include "core/support/grouted_bolt.h"

#include <algorithm>

namespace hdem
{
namespace
{
void install(const Bolt& bolt, State& state)
{
    std::vector<double>& history = state.support.history;
    std::fill_n(history.begin() + bolt.history, bolt.history_size, 0.0);
    const Blocks& blocks = state.blocks;
    for (std::size_t l = 0; l < bolt.links.size(); ++l)
    {
        const LinkPlace at = place_of(bolt, bolt.links[l], blocks);
        if (bolt.kind == BoltKind::anchored)
            memory_of<AnchoredMemory>(bolt, history)[l].free = at.distance - bolt.pretension / bolt.stiffness;
        else if (bolt.kind == BoltKind::local)
        {
            memory_of<LocalMemory>(bolt, history)[l].free = at.distance;
            memory_of<LocalMemory>(bolt, history)[l].straight = at.across;
        }
        else
            grouted_memory(bolt, history).opening[l] = at.distance;
    }
}
}  // namespace

bool has_support(const SupportState& support)
{
    return std::ranges::any_of(support.bolts, [](const BoltRecord& record) { return record.status != BoltStatus::planned; }) ||
           std::ranges::any_of(support.liners, [](const LinerRecord& record) { return record.installed != 0; });
}

std::vector<Index> bolted_blocks(const Model& model, const State& state)
{
    std::vector<Index> blocks;
    for (const BoltEnd& end : model.support.ends)
        if (state.support.bolts[end.bolt].status != BoltStatus::planned && (blocks.empty() || blocks.back() != end.block))
            blocks.push_back(end.block);
    for (const LinerTie& tie : model.support.ties)
        if (state.support.liners[tie.liner].installed != 0)
            blocks.push_back(tie.block);
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

bool install_bolts(const Model& model, State& state)
{
    bool any = false;
    for (std::size_t i = 0; i < model.support.bolts.size(); ++i)
    {
        const Bolt& bolt = model.support.bolts[i];
        if (bolt.stage != state.stage)
            continue;
        install(bolt, state);
        state.support.bolts[i] = {.status = BoltStatus::elastic,
                                  .force = bolt.pretension,
                                  .greatest_force = bolt.pretension,
                                  .stored = energy_in(bolt.pretension, bolt.stiffness)};
        any = true;
    }
    return any;
}
}  // namespace hdem
