#pragma once
/// Water in the joints, with names resolved to numbers. Constant during a run; which water table acts follows from the number of the stage.

#include "core/types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hdem
{
/// Height of the water over a line across gravity: straight between its points, level beyond them. No point: no water.
struct WaterTable
{
    std::vector<Vec2> points;  ///< across gravity, against gravity; ascending [m]

    [[nodiscard]] double height(double across) const;
};

/// A crack with water that seeps out along a plane.
struct WaterCrack
{
    std::vector<Vec2> crack;   ///< water stands in it up to `level`; local coordinates [m]
    std::vector<Vec2> outlet;  ///< from the crack's last point to where the pressure is 0 [m]
    double level = 0.0;        ///< against gravity [m]
};

/// Pressures from elsewhere, linear in triangles.
struct PressureField
{
    std::vector<Vec2> points;                    ///< local coordinates [m]
    std::vector<double> pressure;                ///< [Pa]
    std::vector<std::array<Index, 3>> triangle;  ///< anticlockwise
};

struct Water
{
    bool given = false;
    double unit_weight = 0.0;  ///< rho_w g [N/m3]
    Vec2 up = {0.0, 1.0};      ///< against gravity [-]
    std::vector<WaterTable> tables;
    std::vector<Index> table_of_stage;      ///< position in `tables`, or no_index
    bool ponded = true;                     ///< water presses on free faces too
    std::vector<std::uint8_t> wet_law;      ///< per joint law: does water get into such joints?
    std::vector<std::uint8_t> wet_opening;  ///< per excavation: is it flooded, where water stands higher?
    std::vector<WaterCrack> cracks;
    PressureField field;
    double tolerance = 0.0;   ///< distance from a crack's line at which a joint lies on it [m]
    std::vector<Vec2> drawn;  ///< centroids of the blocks as drawn, in the user's order, local coordinates [m]
};
}  // namespace hdem
