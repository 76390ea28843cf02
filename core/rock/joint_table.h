#pragma once
/// Which joint acts where.

#include "core/model/case_def.h"
#include "core/model/model.h"

namespace hdem
{
/// The joint of each pair of materials, and of each fault, outline, joint set and trace that names one; the joint of walls.
/// @pre  the table holds the laws (joint_laws.h)
void assign_joints(const CaseDef& def, Model& model);
}  // namespace hdem
