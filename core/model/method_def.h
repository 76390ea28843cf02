#pragma once
/// How a case is calculated: method, contacts, damping, time step.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include <optional>

namespace hdem
{
enum class Method
{
    force,    ///< springs with Coulomb slip at every contact, Eqs. (1)-(14)
    impulse,  ///< momentum exchange at every contact, Eqs. (15)-(22)
    hybrid    ///< chosen per contact point and cycle by the threshold velocity, Eqs. (24)-(30)
};

/// [contact]
struct ContactDef
{
    Method method = Method::hybrid;
    double restitution = 0.1;                  ///< R of Eq. (15) [-]
    std::optional<double> threshold_scale;     ///< C_scale of Eq. (25); not given: Eq. (28)
    std::optional<double> threshold_velocity;  ///< instead of Eq. (25) [m/s]
    bool fixed_mass_counts = false;            ///< fixed blocks keep their mass in m_c of Eqs. (16), (27)
    int impulse_sweeps = 10;
    double correction_fraction = 1.0;  ///< share of the overlap that impulse contacts take back each cycle, Eq. (19)
    double allowed_overlap = 1.0e-7;   ///< overlap that position correction leaves [m]
    double correction_rate =
        0.02;  ///< most of older overlap that is taken back in a second, as a share of the smaller block's size [1/s]
    double length_floor = 1.0e-3;  ///< least contact length, as a share of the smaller block's size [-]
    double overlap_limit = 0.25;   ///< a run stops when an overlap exceeds this share of the smaller block's size [-]
    double recycling_distance =
        1.0e-4;          ///< way after which features are searched anew, as a share of the smaller block's size [-]; 0: every cycle
    double skin = 0.05;  ///< pairs closer than this share of the mean block size are tracked [-]
};

enum class DampingPreset
{
    automatic,  ///< hdem's own: see core/motion/damping.h
    paper,      ///< sect. 3.3 to the letter, and springs that close and open by whole cycles (core/contact/closing.h)
    dynamic     ///< no local damping: exact motion
};

/// [damping]
struct DampingDef
{
    DampingPreset preset = DampingPreset::automatic;
    double local = 0.8;                 ///< alpha of Eqs. (13), (14) [-]
    double global_damping_ratio = 0.0;  ///< xi_g of Eq. (22) [-]
    double average_frequency = 0.0;     ///< omega_avg of Eq. (22) [rad/s]
};

/// [time]
struct TimeDef
{
    std::optional<double> step;    ///< [s]; not given: default_time_step, core/motion/time_step.h
    double fraction = 0.1;         ///< FRAC of Eq. (32) [-]
    double stable_fraction = 0.9;  ///< of the largest stable step, see core/motion/step_control.h [-]
};
}  // namespace hdem
