#pragma once
/// The stages of a case, when one ends, and the search for a factor of safety that follows them.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/model/factor_def.h"
#include "core/model/joint_def.h"
#include "core/model/material_def.h"
#include "core/model/method_def.h"
#include "core/model/stage_end.h"
#include "core/types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// Which free blocks are to be at rest.
enum class ConvergenceBlocks
{
    all,
    standing  ///< those that have not moved farther than loose_distance in their stage
};

/// [convergence]
struct ConvergenceDef
{
    ConvergenceBlocks blocks = ConvergenceBlocks::all;
    std::vector<std::string> criteria = {"kinetic_energy", "unbalanced_force_ratio", "every_block"};  ///< all listed must hold
    double mean_speed = 5.0e-4;              ///< kinetic energy of the free blocks in question at this speed is the limit [m/s]
    double unbalanced_force_ratio = 1.0e-5;  ///< [-]
    double block_unbalanced_ratio = 1.0e-4;  ///< [-]
    double hold_time = 0.025;                ///< all criteria must have held at all checks for so long [s]
    std::int64_t least_cycles = 1000;        ///< not tested earlier in a stage
    std::int64_t check_every = 10;           ///< tested at multiples of this many cycles
    double loose_distance = 0.05;            ///< a block that moved farther in its stage is loose [m]
    double detached_distance = 0.1;          ///< a block that moved farther counts as detached [m]
    std::optional<double>
        lost_distance;  ///< one farther outside the model has left it; not given: ten times the greater of its width and height [m]
};

/// How a stage that ends at rest looks for it.
enum class RestSolver
{
    statics,   ///< by a static solution where that is possible, then by cycles
    dynamics,  ///< by cycles alone
    automatic  ///< as statics where the answer is the same and comes sooner, see resolve_rules; else as dynamics
};

/// [[stage]]
struct StageDef
{
    std::string name;
    std::optional<std::int64_t> cycles;  ///< run this many
    std::optional<double> duration;      ///< or this long [s]
    bool until_converged = false;        ///< or until converged, at most max_cycles
    std::vector<StageEndDef> ends;       ///< or until one of these; the first that is met ends the stage
    std::int64_t max_cycles = 1'000'000;
    RestSolver solver = RestSolver::automatic;
    std::int64_t relax_cycles = 0;      ///< over which the forces of excavated blocks are taken off; 0: at once
    double relax_to = 0.0;              ///< share of these forces that is left then, until the stage ends [-]
    std::vector<std::string> excavate;  ///< excavation or block names removed at the start of the stage
    std::vector<std::string> fix;       ///< block names fixed at the start
    std::vector<std::string> free;      ///< block names freed at the start
    std::optional<double> water_level;  ///< of [water] from here on [m]
    Polygon water_table;                ///< or the table [m]
    std::vector<std::string> set;       ///< "joint.NAME.KEY = VALUE", "material.NAME.density = VALUE": numbers from here on
    std::int64_t set_cycles = 0;        ///< over which strengths of joints come to these values; 0: at once
    FactorTable set_table;              ///< or rows: since the stage began, share of the change; the last one is 1
    std::string set_table_file;         ///< or a CSV file with such rows and a heading: cycle,factor or time,factor
    TableColumn set_table_by = TableColumn::cycle;
    std::vector<JointDef> joints;          ///< all joints from here on, where `set` changes some; found by io/
    std::vector<MaterialDef> materials;    ///< all materials from here on, likewise
    std::optional<Method> method;          ///< from here on
    std::optional<DampingPreset> damping;  ///< from here on
};

/// What the trials of a strength reduction begin from, where blocks gave way in the last stage.
enum class FactorStart
{
    last_stage,  ///< the stage is run anew under great strength
    last_state   ///< where they lie
};

/// [factor_of_safety]: strength reduction by `hdem fos`, once all stages have run.
struct FactorOfSafetyDef
{
    std::vector<std::string> reduce = {"joints"};  ///< "joints": all; or names of [joint.NAME]
    Vec2 bracket = {0.5, 3.0};                     ///< factors that the search begins with where no bound is known [-]
    double tolerance = 0.01;                       ///< width of the last bracket [-]
    std::optional<double> displacement;            ///< a block that moved farther has failed; not given: core/stage/failure.h [m]
    double least_size = 0.0;                       ///< smaller blocks may fall [m2]
    FactorStart begin = FactorStart::last_stage;
    bool peak = true;              ///< find the factor of the peak strength too, where slip or breaking takes some
    double check_stiffness = 3.0;  ///< look whether the factor is the same with joints that many times as stiff; 1: do not
};
}  // namespace hdem
