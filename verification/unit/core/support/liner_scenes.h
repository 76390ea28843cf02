#pragma once
/// What the tests of linings share.

#include "parallel/stages.h"
#include "verification/unit/case_run.h"

namespace hdem::test
{
inline LinerDef lining()
{
    LinerDef liner{.name = "liner", .path = {{1.0, 0.0}, {-1.0, 0.0}}, .thickness = 0.05, .modulus = 1e9};
    liner.segment = 0.1;
    liner.normal_stiffness = 1e8;
    liner.bond_strength = 1e5;
    liner.cohesion = 1e5;
    return liner;
}

/// A lining below a roof that does not move, held by its bond alone.
inline CaseDef hanging(double bond_over_weight)
{
    LinerDef liner = lining();
    liner.bond_strength = bond_over_weight * liner.density * 9.81 * liner.thickness;
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "roof", scenes::rectangle({-1.0, 0.0}, {1.0, 1.0}));
    scenes::add_fixed_block(scene, "stand", scenes::rectangle({3.0, 0.0}, {5.0, 1.0}));
    scenes::add_block(scene, "stone", scenes::rectangle({3.5, 1.0}, {4.5, 2.0}));
    scene.liners = {liner};
    scene.stages = {{.name = "hang", .until_converged = true, .max_cycles = 20000}};
    return scene;
}

inline std::vector<StageResult> run_all(CaseRun& run)
{
    return run_stages(run.simulation, {});
}
}  // namespace hdem::test
