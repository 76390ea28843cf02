#pragma once
/// From the numbers of [joint.NAME] to joint laws.

#include "core/model/case_def.h"
#include "core/model/model.h"

#include <vector>

namespace hdem
{
/// What the numbers of a law depend on besides the joint's own values.
struct JointSurroundings
{
    double normal_stress = 0.0;  ///< greatest that is expected, where the joint does not say [Pa]
    double block_size = 0.0;     ///< [m]
    double restitution = 0.0;    ///< [-]
    double reach = 0.0;          ///< gap up to which a joint may bear tension: contacts must still be tracked there [m]
};

/// Where the rock lies, and how it is cut.
struct RockExtent
{
    double low = 0.0, high = 0.0;     ///< y, local coordinates [m]
    double along_gravity = 0.0;       ///< [m]
    std::vector<double> along_loads;  ///< along the acceleration of each load [m]
    double block_size = 0.0;          ///< [m]
};

/// Greatest normal stress that joints of a case are to be ready for: twice that of [insitu] or of the rock's weight, four times that of loads over the block
/// size or of a boundary, 10 MPa where there is nothing [Pa].
/// @param rock  where it lies
[[nodiscard]] double expected_stress(const CaseDef& def, const InsituField& insitu, const RockExtent& rock);

/// Does the joint need a memory? Coulomb's law with friction and cohesion alone does not: it slips at the same strength for ever.
[[nodiscard]] bool needs_memory(const JointDef& joint);

/// The laws of all joints, and behind them those of blocks that have met since the start: no cohesion, no tension, residual friction, no dilation.
/// With stages that change joints all have such a second row, so that positions stay.
void add_laws(const CaseDef& def, const JointSurroundings& around, JointTable& table);

/// The laws of each stage whose `set` changes joints.
[[nodiscard]] std::vector<StageLaws> laws_of_stages(const CaseDef& def, const JointSurroundings& around);
}  // namespace hdem
