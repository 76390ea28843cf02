#pragma once
/// One hard scene, run and watched.

#include "verification/checks/robust_blocks.h"
#include "verification/checks/robust_watch.h"

namespace hdem::verification
{
/// How each scene is solved.
struct RobustVariant
{
    std::string name;
    std::string method;
    std::string damping;
    double restitution = 0.1;
    bool comes_to_rest = false;  ///< within the time of a scene
    bool has_bars = true;
};

/// Each method as it is by default, and without local damping, with half of the speed left after an impact; last, impacts without any loss, which
/// only inform: Newton's restitution with friction adds energy even to a single block.
[[nodiscard]] const std::vector<RobustVariant>& robust_variants();

struct RobustOutcome
{
    RobustWatch watch;
    std::string failure;    ///< why the run stopped before its end
    double residual = 0.0;  ///< worst of the energy ledger, as a share of its greatest term
    bool had_impulses = false;
};

/// Runs to the end of the scene or to an error. A finished run goes into the report, if there is one.
[[nodiscard]] RobustOutcome run_scene(const Scene& scene, const RobustVariant& variant, Report* report = nullptr);

struct RobustBars
{
    double overlap = 0.25;      ///< of a width: half of what lets a block come out behind
    double energy_gain = 0.01;  ///< of the greatest energy: contacts know of each other what the last cycle did
    double speed = 1.01;        ///< of what energy allows
    double late_speed = 5e-4;   ///< the speed at which hdem calls rock at rest [m/s]
    double carried = 0.01;      ///< of the weight
};
inline constexpr RobustBars robust_bars;
}  // namespace hdem::verification
