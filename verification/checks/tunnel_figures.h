#pragma once
/// Figs. 11 to 13 of [Lee2025] from runs of the tunnel.

#include "verification/checks/case_run.h"
#include "verification/checks/radial_profile.h"

namespace hdem::verification
{
struct TunnelRun
{
    std::string name;
    std::string method;
    CaseRun run;
    double limit = 0.0;  ///< kinetic energy that counts as rest [J]
    Series kinetic;      ///< kinetic energy of all blocks, every `kinetic_every` cycles
    inline static constexpr std::int64_t kinetic_every = 10;

    TunnelRun(const std::string& run_name, const std::string& run_method, double restitution);
};

/// The angles of Fig. 12 are not printed; three rays go up, into the shallower rock, and three down [deg].
inline constexpr std::array<double, 6> profile_angles_deg{30.0, 90.0, 150.0, 210.0, 270.0, 330.0};

/// From half of the opening's height; the ray ends ten metres behind its boundary.
[[nodiscard]] Ray profile_ray(const CaseRun& run, double angle_deg);

/// Mean of the traction on the profile's contacts between two distances from the centre; NaN without any [Pa].
[[nodiscard]] double mean_traction(const CaseRun& run, double angle_deg, double from, double to);

/// Maps of the displacements since the excavation and of the mean stress in the blocks.
[[nodiscard]] Figure displacement_figure(const TunnelRun& force, const TunnelRun& hybrid);
[[nodiscard]] Figure stress_figure(const TunnelRun& force, const TunnelRun& hybrid);
[[nodiscard]] Figure kinetic_figure(const TunnelRun& force, const TunnelRun& hybrid, const TunnelRun& matched);
}  // namespace hdem::verification
