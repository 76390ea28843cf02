#pragma once
/// Runs a scene as `hdem run` does, and tells what became of it.

#include "verification/rest/limit_analysis.h"
#include "verification/rest/scene.h"
#include "verification/rest/watch.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem::verification::rest
{
/// In the upright axes of the scene, whatever its placement; one entry a block, in the order of the scene.
struct Outcome
{
    std::string failure;     ///< why the run was refused, or stopped before its end; what follows is empty then
    bool converged = false;  ///< of its last stage
    std::int64_t cycles = 0;
    double time = 0.0;  ///< [s]
    bool had_impulses = false;
    std::vector<Vec2> way;         ///< of the centroid since the start [m]
    std::vector<double> rotation;  ///< [rad]
    std::vector<Body> bodies;      ///< where they are at the end
    Loads net;                     ///< force and moment out of balance, as hdem has them
    std::vector<Vec2> carried;     ///< one per Scene::supports: force of the lower on the upper block [N]
    Peak peak;
    double rise = 0.0;      ///< of energy, see EnergyWatch [-]
    double residual = 0.0;  ///< of the energy ledger [-]
};

/// Way of the block's centroid and, by its rotation, of its rim; the farthest of all [m].
[[nodiscard]] double rim_way(const Outcome& outcome, std::size_t block);
[[nodiscard]] double farthest_way(const Outcome& outcome);

/// Text of the case file of the scene in that placement.
[[nodiscard]] std::string scene_text(const Scene& scene, const Placement& placement);

[[nodiscard]] Outcome run_scene(const Scene& scene, const Placement& placement);

/// The same scene for `seconds`, at that step, in a stage without any of the short cuts of those that run until converged.
[[nodiscard]] Scene slow_version(const Scene& scene, double step, double seconds);

/// What is left after `cycles`, or at the end, on so many threads.
struct Trace
{
    std::uint64_t hash = 0;  ///< of the state
    Index contacts = 0;      ///< that are tracked
};
[[nodiscard]] Trace trace(const Scene& scene, const Placement& placement, std::int64_t cycles, int threads);
}  // namespace hdem::verification::rest
