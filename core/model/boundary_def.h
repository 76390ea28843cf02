#pragma once
/// [[boundary]] of a case: what holds or presses the sides of the domain.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/model/factor_def.h"
#include "core/types.h"

#include <optional>
#include <string>
#include <vector>

namespace hdem
{
enum class BoundaryKind
{
    fixed,     ///< blocks with an edge on the side do not move
    roller,    ///< a wall without friction
    stress,    ///< a given traction
    velocity,  ///< a wall that moves as prescribed
    servo      ///< a wall that moves until it presses with a given stress
};

/// [[boundary]]: what holds or presses a side of the domain.
struct BoundaryDef
{
    std::string name;        ///< "boundary1", ... when not given
    std::string side;        ///< of a rectangle: "left", "right", "bottom" or "top"
    std::vector<int> edges;  ///< or of domain.polygon, 0 = first to second vertex
    BoundaryKind kind = BoundaryKind::fixed;
    bool is_insitu = false;              ///< stress: sigma n of [insitu]
    std::optional<Vec2> stress;          ///< or compression, and shear along the side anticlockwise [Pa]
    Vec2 stress_gradient = {0.0, 0.0};   ///< change of both upwards [Pa/m]
    double stress_height = 0.0;          ///< y at which `stress` holds [m]
    double target = 0.0;                 ///< servo: compression [Pa]
    std::optional<double> max_velocity;  ///< servo; not given: convergence.mean_speed [m/s]
    Vec2 velocity = {0.0, 0.0};          ///< velocity [m/s]
    std::vector<std::string> stages;     ///< in which it acts; empty: all
    FactorDef factor;                    ///< of stress, velocity, target
};
}  // namespace hdem
