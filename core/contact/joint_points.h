#pragma once
/// Points of joints whose law has a memory, four contacts at a time.

#include "core/contact/row_lanes.h"
#include "core/contact/spring_points.h"

namespace hdem
{
/// What a cycle reads and writes of four contacts besides their places.
struct JointPlace
{
    ContactLanes& lanes;
    MemoryLanes& memory;
    std::array<std::uint8_t*, 2> regime;
    const RowLanes& rows;
};

/// Ask the law of each lane and let the points remember. Lanes that are plain are computed as in rock without memories.
/// @param share  of the force that a spring gives that closes or opens in this cycle (closing.h)
/// @pre   one of the four contacts has a memory
void evaluate_joint_points(const ContactGroup& g, Mask impulsive, const std::array<Pack, 2>& share, Pack dt,
                           const JointPlace& place, Sums& sums);
}  // namespace hdem
