#pragma once
/// Scenes whose second stage changes numbers of joints and materials.

#include "verification/unit/case_run.h"

#include <cmath>
#include <functional>

namespace hdem::test
{
inline double ledger_residual(const CaseRun& run)
{
    return std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())));
}

/// Two stages; the second has the joints and materials of the case, changed.
inline CaseDef with_change(CaseDef scene, const std::function<void(JointDef&)>& joint, double density = 0.0)
{
    scene.stages = {{.name = "settle", .cycles = 4000}, {.name = "changed", .cycles = 4000}};
    StageDef& stage = scene.stages.back();
    stage.joints = scene.joints;
    for (JointDef& j : stage.joints)
        joint(j);
    if (density > 0.0)
        stage.materials = {{.name = scene.materials[0].name, .density = density}};
    return scene;
}
}  // namespace hdem::test
