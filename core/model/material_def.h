#pragma once
/// [material.NAME] of a case.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include <string>

namespace hdem
{
/// [material.NAME]
struct MaterialDef
{
    std::string name;
    double density = 0.0;  ///< [kg/m3]

    bool operator==(const MaterialDef&) const = default;
};
}  // namespace hdem
