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
/// What can be a name, that none is given twice, and materials and joints that others refer to:
void check_names(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Keys of domain, faults, regions, joint sets, excavations and stress at the start:
void check_rock_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Keys of boundaries:
void check_boundary_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Keys of bolts:
void check_support_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Keys of water:
void check_water_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Which numbers the law of each joint takes, and what they may be:
void check_joint_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Keys of loads, settings and the search for a factor of safety:
void check_run_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Keys of stages and their ends:
void check_stage_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Keys of histories:
void check_history_keys(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
/// Numbers that are likely to be meant in another unit:
void warn_of_units(const CaseDef& def, const CaseSource& source, CaseProblems& problems);
}  // namespace hdem
