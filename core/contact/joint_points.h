#pragma once
/// Points of joints whose law has a memory.

#include "core/contact/row_lanes.h"
#include "core/contact/spring_points.h"

namespace hdem
{
/// What a cycle reads and writes of the contacts of a pack, besides positions. Wider packs continue in the next element of `lanes` and `memory`.
template <typename P>
struct BasicJointPlace
{
    ContactLanes& lanes;
    MemoryLanes& memory;
    std::array<std::uint8_t*, 2> regime;
    const BasicRowLanes<P>& rows;
};

/// Evaluate the law of each lane and update the points' memories. Plain lanes are computed as in rock without memories.
/// @param share  of the force that a spring gives that closes or opens in this cycle (closing.h)
/// @pre   one of the four contacts has a memory
void evaluate_joint_points(const ContactGroup& g, Mask impulsive, const std::array<Pack, 2>& share, Pack dt,
                           const BasicJointPlace<Pack>& place, Sums& sums);
}  // namespace hdem
