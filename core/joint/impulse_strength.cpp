#include "core/joint/impulse_strength.h"

#include "core/joint/all_laws.h"

namespace hdem
{
ImpulseStrength impulse_strength(const CoulombSlip& slip, const JointRow& row, const JointMemory& memory)
{
    if (memory.broken < 0.5)
        return {slip.friction_coefficient, slip.cohesion, row.tension};
    const double tension = row.kind == kind_of<CoulombResidual>() ? row.numbers[CoulombResidual::residual_tension] : 0.0;
    return {row.residual_friction, row.residual_cohesion, tension};
}

double dilation_by_slip(const JointRow& row, const JointMemory& memory)
{
    return row.kind == kind_of<CoulombResidual>() ? CoulombResidual::opening(row.numbers, memory) : 0.0;
}
}  // namespace hdem
