#include "core/contact/block_forces.h"

#include "core/simd.h"

#include <algorithm>

namespace hdem
{
void list_block_contacts(const Contacts& contacts, Index blocks, BlockContacts& list)
{
    list.begin.assign(static_cast<std::size_t>(blocks) + 1, 0);
    list.entry.resize(2 * static_cast<std::size_t>(contacts.size()));
    for (Index i = 0; i < contacts.size(); ++i)
    {
        ++list.begin[contacts.ref[i] + 1];
        ++list.begin[contacts.inc[i] + 1];
    }
    for (Index b = 0; b < blocks; ++b)
        list.begin[b + 1] += list.begin[b];
    std::vector<Index> at(list.begin.begin(), list.begin.end() - 1);
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index swapped = contacts.swapped[i];
        list.entry[at[contacts.ref[i]]++] = 2 * i + swapped;
        list.entry[at[contacts.inc[i]]++] = 2 * i + 1 - swapped;
    }
}

namespace
{
double squared_force(const ContactLoads& loads, Index entry)
{
    const auto& load = loads.load[entry];
    return load.x * load.x + load.y * load.y;
}

template <bool find_joint>
void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, Blocks& blocks)
{
    const Vec2 g = model.gravity;
    for (Index b = range.begin; b < range.end; ++b)
    {
        const double mass = blocks.present[b] != 0 ? model.mass[b] : 0.0;
        Pack sum(Pack::V{mass * g.x(), mass * g.y(), 0.0, 0.0});
        if (!external.empty())
            sum += Pack(Pack::V{external[b].x, external[b].y, external[b].w, 0.0});
        BlockForce force;
        Index most = no_index;
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
        {
            const Index entry = list.entry[e];
            sum += Pack::load(&loads.load[entry].x);
            const JointUse& use = loads.use[entry / 2];
            force.contacts |= use.contacts;
            if constexpr (find_joint)
            {
                // Two joints that slide have both all of their strength in use: the one that bears more counts, whichever stands first.
                if (use.mobilised > force.mobilised || (use.mobilised == force.mobilised && most != no_index &&
                                                        squared_force(loads, entry) > squared_force(loads, most)))
                {
                    most = entry;
                    force.mobilised = use.mobilised;
                }
            }
        }
        sum.store(&force.x);
        if (most != no_index)
        {
            const JointUse& use = loads.use[most / 2];
            force.t_x = use.t_x;
            force.t_y = use.t_y;
        }
        blocks.force[b] = force;
    }
}
}  // namespace

void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, bool find_joint, Blocks& blocks)
{
    if (find_joint)
        sum_forces<true>(range, model, list, loads, external, blocks);
    else
        sum_forces<false>(range, model, list, loads, external, blocks);
}
}  // namespace hdem
