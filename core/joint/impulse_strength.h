#pragma once
/// What impulses need of a joint: its strength, and how far its slip has opened it.

#include "core/joint/coulomb_slip.h"
#include "core/joint/joint_row.h"

namespace hdem
{
/// Strength of a point under impulses, which know no stiffness: |tau| <= c + sigma tan(phi), sigma >= -T.
struct ImpulseStrength
{
    double friction = 0.0;  ///< tan phi [-]
    double cohesion = 0.0;  ///< c [Pa]
    double tension = 0.0;   ///< T [Pa]
};

/// Strength of a point with this memory. A broken point has its residual strength. Laws with roughness give their basic friction.
[[nodiscard]] ImpulseStrength impulse_strength(const CoulombSlip& slip, const JointRow& row, const JointMemory& memory);

/// Opening of the joint by slip, where it follows from the slip alone (coulomb); else 0 [m].
[[nodiscard]] double dilation_by_slip(const JointRow& row, const JointMemory& memory);
}  // namespace hdem
