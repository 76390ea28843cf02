#include "core/detection/bearing_force.h"

namespace hdem
{
bool notes_bearing_forces(std::int64_t cycles_of_stage)
{
    constexpr std::int64_t always = 64, seldom = 64;
    return cycles_of_stage < always || cycles_of_stage % seldom == 0;
}

void note_bearing_forces(IndexRange range, const BlockContacts& list, const Contacts& contacts, Blocks& blocks)
{
    for (Index b = range.begin; b < range.end; ++b)
    {
        double sum = 0.0;
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
            for (int end = 0; end < 2; ++end)
                if (const Index contact = list.entry[e] / 2; is_spring(contacts.regime[end][contact]))
                    sum += contacts.normal_force(end, contact);
        blocks.bearing_force[b] = sum;
    }
}
}  // namespace hdem
