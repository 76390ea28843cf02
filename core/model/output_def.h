#pragma once
/// What a run of a case writes.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// [[history]]: quantities sampled every n cycles into results.h5.
struct HistoryDef
{
    std::string name;
    std::string block;  ///< block quantities: displacement, position, velocity, rotation, angular_velocity, force, kinetic_energy
    std::optional<Vec2> point;  ///< or a place: pore_pressure [m]
    std::vector<std::string>
        between;  ///< or contact quantities between two named blocks: normal_force, shear_force, overlap, shear_displacement, contact_length, impulse_points
    std::string bolt;   ///< or quantities of a bolt: axial_force, across_force, greatest_force, elongation
    std::string liner;  ///< or of a liner: thrust, moment, liner_displacement, hinges
    std::vector<std::string> quantities;
    std::int64_t every = 1;  ///< cycles
};

/// [output]
struct OutputDef
{
    std::int64_t row_every = 1000;          ///< cycles between rows on the screen and in run.log, and samples of the energy history
    std::int64_t frame_every = 0;           ///< cycles between frames; 0: at the end of each stage only
    bool contacts = true;                   ///< write contact frames as well
    std::int64_t checkpoint_every = 0;      ///< cycles between checkpoints; 0: by wall time only
    double checkpoint_wall_minutes = 10.0;  ///< of a clock on the wall; 0: by cycles only
};
}  // namespace hdem
