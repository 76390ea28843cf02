#include "core/contact/island_finder.h"

namespace hdem
{
Index IslandFinder::root(Index block)
{
    while (parent_[block] != block)
        block = parent_[block] = parent_[parent_[block]];
    return block;
}

void IslandFinder::find(const std::vector<std::vector<ImpulsePoint>*>& lists, const Blocks& blocks, std::vector<Island>& islands)
{
    parent_.resize(static_cast<std::size_t>(blocks.size()));
    island_of_.resize(static_cast<std::size_t>(blocks.size()));
    place_.resize(static_cast<std::size_t>(blocks.size()));
    islands.clear();
    const auto movable = [&](Index block) { return can_move(blocks.inertia[block]); };
    for (const auto* list : lists)
        for (const ImpulsePoint& p : *list)
            for (const Index block : {p.ref, p.inc})
            {
                parent_[block] = block;
                island_of_[block] = place_[block] = no_index;
            }
    for (const auto* list : lists)
        for (const ImpulsePoint& p : *list)
            if (movable(p.ref) && movable(p.inc))
                parent_[root(p.ref)] = root(p.inc);
    for (auto* list : lists)
        for (ImpulsePoint& p : *list)
        {
            if (!movable(p.ref) && !movable(p.inc))
                continue;
            Index& number = island_of_[root(movable(p.ref) ? p.ref : p.inc)];
            if (number == no_index)
            {
                number = static_cast<Index>(islands.size());
                islands.emplace_back();
            }
            Island& island = islands[number];
            const auto place = [&](Index block)
            {
                if (movable(block) && place_[block] == no_index)
                {
                    place_[block] = static_cast<Index>(island.blocks.size());
                    island.blocks.push_back(block);
                }
                return place_[block];
            };
            island.points.push_back(&p);
            const Index ref = place(p.ref);
            island.ends.push_back({ref, place(p.inc)});
        }
}
}  // namespace hdem
