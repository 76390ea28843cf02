#pragma once
/// Water in joints and in cracks, as a case gives it.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/types.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// [[water_crack]]: a crack with standing water that seeps out along a plane.
struct WaterCrackDef
{
    Polygon crack;       ///< its points; the last one is its foot [m]
    Polygon outlet;      ///< points from the foot on; at the last one the pressure is 0 [m]
    double level = 0.0;  ///< of the water in the crack, against gravity [m]
};

/// [water]: pressure in the joints and on free faces; its level by `level`, `table` or `pressure`.
struct WaterDef
{
    bool given = false;
    std::optional<double> level;                   ///< against gravity [m]
    Polygon table;                                 ///< points of the water table [m]
    double density = 1000.0;                       ///< [kg/m3]
    std::string pressure;                          ///< CSV file of x, y, pressure
    std::vector<std::array<double, 3>> pressures;  ///< its rows, found by io/ [m], [m], [Pa]
    bool ponded = true;                            ///< presses on free faces below the table too
    std::vector<std::string> joints;               ///< that water gets into; empty: all
    std::vector<std::string> flooded;              ///< excavations that are not drained
};
}  // namespace hdem
