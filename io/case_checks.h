#pragma once
/// What can be wrong with a case although each of its keys is right: keys that exclude each other, names that nothing has.

#include "core/model/case_def.h"
#include "io/case_problems.h"
#include "io/case_source.h"

namespace hdem
{
/// Geometry (simple polygons, outlines inside the domain, the number of blocks) is checked by core/rock, which cuts them. Names of generated blocks
/// do not exist yet; with a [domain], unknown block names are left to the model.
///
/// Of domain, joint sets, excavations, blocks, materials and joints, and all names:
void check_rock_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Of boundaries:
void check_boundary_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Of bolts:
void check_support_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Of water:
void check_water_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Which numbers the law of each joint takes, and what they may be:
void check_joint_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Of loads, settings, stages and histories:
void check_run_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
}  // namespace hdem
