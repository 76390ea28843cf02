#include "core/detection/bearing_force.h"

#include <algorithm>

namespace hdem
{
bool notes_bearing_forces(std::int64_t cycles_of_stage)
{
    constexpr std::int64_t first = 64, often = 8, seldom = 256;
    return cycles_of_stage % (cycles_of_stage < first ? often : seldom) == 0;
}

void note_bearing_forces(IndexRange range, const BlockContacts& list, const Contacts& contacts, Blocks& blocks)
{
    const std::uint8_t* const regime[2] = {contacts.regime[0].data(), contacts.regime[1].data()};
    const ContactLanes* const groups = contacts.lane.data();
    for (Index b = range.begin; b < range.end; ++b)
    {
        double sum = 0.0;
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
        {
            const auto contact = static_cast<std::uint32_t>(list.entry[e]) / 2;
            const std::array<ContactLanes::Lane, 2>& force = groups[contact / lanes].normal_force;
            for (int end = 0; end < 2; ++end)
                if (is_spring(regime[end][contact]))
                    sum += std::max(force[end][contact % lanes], 0.0);  // of joints that are pulled, < 0
        }
        blocks.bearing_force[b] = sum;
    }
}
}  // namespace hdem
