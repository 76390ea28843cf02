#pragma once
/// What a liner remembers, in SupportState::history.

#include "core/model/support.h"

#include <span>
#include <vector>

namespace hdem
{
/// Memory of one segment. Numbers of its two ends stand next to each other.
struct LinerSegmentMemory
{
    double place[2][2] = {};  ///< of the rock's two points when it was installed: x, y of each [m]
    double slip[2] = {};      ///< of its tie along it [m]
    double pressed[2] = {};   ///< normal force of its tie in the last cycle [N]
    double parted[2] = {};    ///< 1: it has come off the rock
    double plastic = 0.0;     ///< elongation [m]
    double turned[2] = {};    ///< plastic rotations [rad]
    double hinge[2] = {};     ///< 1: its strength in bending has been reached there
};

/// Factor of modulus and strengths in the last cycle, displacements and velocities of the nodes (x, y, rotation of each), then the segments.
struct LinerMemory
{
    double* factor;
    std::span<double> moved;     ///< [m], [rad]
    std::span<double> velocity;  ///< [m/s], [rad/s]
    LinerSegmentMemory* segment;
};

[[nodiscard]] inline Index liner_history_size(const Liner& liner)
{
    constexpr std::size_t numbers = sizeof(LinerSegmentMemory) / sizeof(double);
    return static_cast<Index>(1 + 6 * liner.nodes.size() + numbers * liner.segments.size());
}

/// Displacements and velocities of its nodes, to look at.
struct LinerNodes
{
    std::span<const double> moved, velocity;
};

[[nodiscard]] inline LinerNodes liner_nodes_of(const Liner& liner, const std::vector<double>& history)
{
    const double* at = history.data() + liner.history;
    const std::size_t n = 3 * liner.nodes.size();
    return {{at + 1, n}, {at + 1 + n, n}};
}

[[nodiscard]] inline LinerMemory liner_memory(const Liner& liner, std::vector<double>& history)
{
    double* at = history.data() + liner.history;
    const std::size_t n = 3 * liner.nodes.size();
    return {at, {at + 1, n}, {at + 1 + n, n}, reinterpret_cast<LinerSegmentMemory*>(at + 1 + 2 * n)};
}
}  // namespace hdem
