#pragma once
/// [joint.NAME] of a case: how two faces bear on each other.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/joint/user_law.h"

#include <optional>
#include <string>
#include <vector>

namespace hdem
{
enum class JointLaw
{
    coulomb,                ///< friction and cohesion; with tension, residual values or dilation: core/joint/coulomb_residual.h
    barton_bandis,          ///< core/joint/barton_bandis.h
    patton,                 ///< core/joint/patton.h
    continuously_yielding,  ///< core/joint/continuously_yielding.h
    plesha,                 ///< core/joint/plesha.h
    saeb_amadei,            ///< core/joint/saeb_amadei.h
    slip_weakening,         ///< core/joint/slip_weakening.h
    library                 ///< of a shared library: core/joint/user_law.h
};

enum class JointStart
{
    intact,
    broken
};

/// [joint.NAME]: properties of a contact; "default" must exist. Which law takes which numbers: io/case_checks_joint.cpp.
struct JointDef
{
    std::string name;
    JointLaw law = JointLaw::coulomb;
    double normal_stiffness = 0.0;                      ///< [Pa/m]; with normal_exponent e: a of K_N = a sigma^e [Pa^(1-e)/m]
    double shear_stiffness = 0.0;                       ///< [Pa/m]; with shear_exponent likewise
    double friction_angle_deg = 0.0;                    ///< [deg]
    double cohesion = 0.0;                              ///< [Pa]
    std::optional<double> tension;                      ///< T [Pa]
    std::optional<double> residual_friction_angle_deg;  ///< [deg]
    std::optional<double> residual_cohesion;            ///< [Pa]
    std::optional<double> residual_tension;             ///< [Pa]
    std::optional<double> dilation_angle_deg;           ///< [deg]
    std::optional<double> dilation_limit;               ///< slip at which dilation stops [m]
    JointStart initially = JointStart::intact;
    std::optional<double> greatest_closure;  ///< V_m of a hyperbolic normal spring [m]
    std::optional<double> normal_exponent;   ///< e of K_N = a sigma^e [-]
    std::optional<double> shear_exponent;    ///< the same of K_S [-]
    double greatest_stiffness = 1e12;        ///< bound of both [Pa/m]
    std::optional<double> normal_stress;     ///< greatest that is expected [Pa]
    double jrc = 0.0;                        ///< JRC_0 [-]
    double jcs = 0.0;                        ///< JCS_0 [Pa]
    std::optional<double> length;            ///< L, block size along the joint [m]
    double damage = 2.0;                     ///< M [-]
    std::optional<double> rock_strength;     ///< sigma_c of the closure by Bandis [Pa]
    int closure_cycle = 3;                   ///< of loading, 1 to 3
    double asperity_angle_deg = 0.0;         ///< i, alpha_0, i_0 [deg]
    double mobilised_angle_deg = 0.0;        ///< phi_m at first [deg]
    double wear_length = 0.0;                ///< R [m]
    double wear = 0.0;                       ///< C [m2/J]
    double transition_stress = 0.0;          ///< sigma_T [Pa]
    double rock_cohesion = 0.0;              ///< s_0 [Pa]
    double rock_friction_angle_deg = 0.0;    ///< phi_0 [deg]
    double residual_displacement = 0.01;     ///< u_r [m]
    double residual_share = 1.0;             ///< B_0 [-]
    std::string library;                     ///< file of a shared library with the law
    std::vector<double> parameters;          ///< of that law
    JointFunction function = nullptr;        ///< found there by io/
    std::optional<double> restitution;       ///< [-] instead of contact.restitution
    std::vector<std::string> materials;      ///< the two materials this joint lies between; empty: only used by name

    bool operator==(const JointDef&) const = default;
};
}  // namespace hdem
