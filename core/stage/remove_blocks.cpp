#include "core/stage/remove_blocks.h"

#include "core/detection/edge_touch.h"
#include "core/motion/released_forces.h"

#include <algorithm>

namespace hdem
{
void remove_block(Index block, Blocks& blocks)
{
    blocks.present[block] = 0;
    blocks.inertia[block] = {};
    blocks.motion[block].vx = blocks.motion[block].vy = blocks.motion[block].w = 0.0;
}

void excavate(const Model& model, const std::string& name, State& state)
{
    const auto at = std::find(model.excavation_names.begin(), model.excavation_names.end(), name);
    const Index excavation = at == model.excavation_names.end() ? no_index
                                                                : static_cast<Index>(at - model.excavation_names.begin());
    const Index single = excavation == no_index ? model.find_block(name) : no_index;
    std::vector<std::uint8_t> removed(static_cast<std::size_t>(model.blocks()), 0);
    for (Index i = 0; i < model.blocks(); ++i)
        removed[i] = (excavation != no_index && model.excavation[i] == excavation) || i == single;

    if (model.stages[state.stage].relax_cycles > 0)
        release_forces(removed, state);
    const Contacts& contacts = state.contacts;
    std::vector<Index>& near = state.next_to_excavation;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index ref = contacts.ref[i];
        const Index inc = contacts.inc[i];
        if (removed[ref] == removed[inc])
            continue;
        // Faces that lay against what is removed, whether or not they carried force.
        const EdgeTouch touch = touch_edges(contacts.edges(i), state.blocks.motion[ref], state.blocks.motion[inc]);
        const double gap = -std::max(touch.point[0].overlap, touch.point[1].overlap);
        if (touch.length > contacts.length_floor(i) && gap < contacts.length_floor(i))
            near.push_back(removed[ref] != 0 ? inc : ref);
    }
    for (Index i = 0; i < model.blocks(); ++i)
        if (removed[i] != 0)
            remove_block(i, state.blocks);
    std::erase_if(near, [&](Index i) { return state.blocks.present[i] == 0; });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    state.contacts_outdated = true;
    state.excavation_cycle = state.cycle;
}
}  // namespace hdem
