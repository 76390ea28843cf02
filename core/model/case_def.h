#pragma once
/// Everything a case file can say, as plain structs with defaults. io/ fills them, core/rock builds a Model from them.
/// Each part has its header. SI units; angles in degrees where the name ends in _deg. Each field's default, range and effect stands once more, for
/// users, in io/case_schema (which writes io/case_format.md).

#include "core/model/boundary_def.h"
#include "core/model/factor_def.h"
#include "core/model/insitu_def.h"
#include "core/model/joint_def.h"
#include "core/model/load_def.h"
#include "core/model/material_def.h"
#include "core/model/method_def.h"
#include "core/model/output_def.h"
#include "core/model/rock_def.h"
#include "core/model/stage_def.h"
#include "core/model/support_def.h"
#include "core/model/trace_cells.h"
#include "core/model/water_def.h"
#include "core/types.h"

#include <string>
#include <vector>

namespace hdem
{
struct CaseDef
{
    std::string title;
    DomainDef domain;
    TraceCells trace_cells;  ///< what faults, outlines and traces cut the domain into, found by io/; empty without
    std::vector<FaultDef> faults;
    std::vector<RegionDef> regions;
    std::vector<JointSetDef> joint_sets;
    VoronoiDef voronoi;
    GeneratorDef generator;
    std::vector<ExcavationDef> excavations;
    std::vector<BlockDef> blocks;
    std::string blocks_file;  ///< WKT, one POLYGON a line; read by io/ into `blocks`
    std::vector<MaterialDef> materials;
    std::vector<JointDef> joints;
    InsituDef insitu;
    WaterDef water;
    std::vector<WaterCrackDef> water_cracks;
    std::vector<BoundaryDef> boundaries;
    std::vector<BoltDef> bolts;
    std::vector<LinerDef> liners;
    Vec2 gravity = {0.0, -9.81};    ///< [m/s2]
    double gravity_tilt_deg = 0.0;  ///< by which the model is tilted, anticlockwise [deg]
    std::vector<LoadDef> loads;
    ContactDef contact;
    DampingDef damping;
    TimeDef time;
    ConvergenceDef convergence;
    std::vector<StageDef> stages;
    FactorOfSafetyDef factor_of_safety;
    std::vector<HistoryDef> histories;
    OutputDef output;
};
}  // namespace hdem
