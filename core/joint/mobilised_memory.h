#pragma once
/// Joints whose strength grows with slip at first, put where they bear a given stress.

#include "core/joint/joint_row.h"

namespace hdem
{
/// Memory after so much more slip that the joint bears these stresses. Of a law without `mobilise` (barton_bandis.h has it) it is as it was.
[[nodiscard]] JointMemory mobilised_memory(const JointRow& row, double normal_stress, double shear_stress, JointMemory memory);
}  // namespace hdem
