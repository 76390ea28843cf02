#pragma once
/// [insitu] of a case: what the rock carries before the first cycle.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include <optional>

namespace hdem
{
/// A stress, tension positive [Pa], or how it changes upwards [Pa/m].
struct StressDef
{
    double xx = 0.0;
    double yy = 0.0;
    double xy = 0.0;
};

/// [insitu]: what the rock carries before the first cycle; either `stress` or `surface`.
struct InsituDef
{
    bool given = false;
    std::optional<StressDef> stress;  ///< at y = reference [Pa]
    StressDef gradient;               ///< d/dy [Pa/m]
    double reference = 0.0;           ///< [m]
    std::optional<double> surface;    ///< y of the ground [m]
    std::optional<double> ratio;      ///< of horizontal to vertical stress [-]
    double ratio_offset = 0.0;        ///< horizontal compression besides [Pa]
};
}  // namespace hdem
