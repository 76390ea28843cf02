#pragma once
/// Bolts and liners of a case.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/model/factor_def.h"
#include "core/types.h"

#include <cstdint>
#include <optional>
#include <string>

namespace hdem
{
enum class BoltKind
{
    anchored,  ///< a bar between two points
    grouted,   ///< a bar that is bonded to the rock along its length
    local      ///< an axial and a shear spring at each joint that it crosses
};

/// [[bolt]]: one bolt (from, to), or a pattern around an excavation (around). Forces are those of one bolt; `spacing` divides them per metre.
struct BoltDef
{
    std::string name;  ///< "bolt1", ... when not given
    BoltKind kind = BoltKind::anchored;
    std::optional<Vec2> from;              ///< its head, as drawn [m]
    std::optional<Vec2> to;                ///< [m]
    std::string around;                    ///< or the name of an excavation, around which bolts stand
    double length = 0.0;                   ///< of each bolt around it [m]
    double along = 0.0;                    ///< distance of their heads along the outline [m]
    std::optional<Vec2> arc;               ///< only between these directions, seen from the middle of the outline [deg]
    std::string stage;                     ///< at whose start it is installed; "" = the first
    double spacing = 1.0;                  ///< of bolts out of plane [m]
    double area = 0.0;                     ///< of the bar [m2]
    double modulus = 2e11;                 ///< of the bar [Pa]
    std::optional<double> stiffness;       ///< anchored: instead of E A / L; local: axial [N/m]
    std::optional<double> free_length;     ///< anchored: that stretches; grouted: without bond, from the head on [m]
    double pretension = 0.0;               ///< anchored [N]
    std::optional<double> yield;           ///< axial force at which it yields [N]
    std::optional<double> rupture_strain;  ///< [-]
    double bond_stiffness = 0.0;           ///< grouted [N/m/m]
    double bond_strength = 0.0;            ///< grouted [N/m]
    std::optional<double> segment;         ///< grouted: longest distance of nodes [m]
    bool plate = false;                    ///< grouted: a plate at the head
    double shear_stiffness = 0.0;          ///< local [N/m]
    std::optional<double> shear_strength;  ///< local [N]
    double active_length = 0.0;            ///< local: across a joint [m]
};

/// [[liner]]: beams along the outline of an excavation (around) or along points (path), and what ties them to the rock. Per metre out of plane.
struct LinerDef
{
    std::string name;                            ///< "liner1", ... when not given
    std::string around;                          ///< name of an excavation
    std::optional<Vec2> arc;                     ///< only between these directions, seen from the middle of the outline [deg]
    Polygon path;                                ///< or points with the rock on the right-hand side, as drawn [m]
    std::string stage;                           ///< at whose start it is installed; "" = the first
    double thickness = 0.0;                      ///< [m]
    double modulus = 0.0;                        ///< [Pa]
    std::optional<double> inertia;               ///< second moment of area instead of thickness^3 / 12 [m4/m]
    double density = 2400.0;                     ///< [kg/m3]
    std::optional<double> compressive_strength;  ///< [Pa]
    std::optional<double> tensile_strength;      ///< [Pa]
    std::optional<double> moment_strength;       ///< [N m/m]
    std::optional<double> segment;               ///< longest distance of nodes [m]
    double normal_stiffness = 0.0;               ///< of what ties it to the rock [Pa/m]
    std::optional<double> shear_stiffness;       ///< the same as normal_stiffness when not given [Pa/m]
    double friction_angle_deg = 30.0;            ///< [deg]
    double cohesion = 0.0;                       ///< [Pa]
    double bond_strength = 0.0;                  ///< tension [Pa]
    FactorTable hardening;                       ///< rows: cycles since it was installed, factor of modulus and strengths
    double pressure = 0.0;                       ///< between rock and liner [Pa]
    std::int64_t pressure_cycles = 0;            ///< over which it grows, since it was installed
};
}  // namespace hdem
