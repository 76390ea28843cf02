#pragma once
/// Memory of joints whose strength first grows with slip, such that they bear a given stress.

#include "core/joint/joint_row.h"

namespace hdem
{
/// Memory after enough further slip for the joint to bear these stresses. Laws without `mobilise` (barton_bandis.h has it) keep their memory.
[[nodiscard]] JointMemory mobilised_memory(const JointRow& row, double normal_stress, double shear_stress, JointMemory memory);
}  // namespace hdem
