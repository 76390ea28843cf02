#pragma once
/// The exact bouncing block.

#include <vector>

namespace hdem::verification
{
/// Velocity, upwards positive, at time t of a block let fall from `height` that rebounds with `restitution` [m/s].
[[nodiscard]] double bounce_velocity(double t, double height, double restitution);

/// [Lee2025] Eq. (34) for the fall from 1 m with restitution 0.5: mean of |v_c - v(c dt)| over all cycles c = 1, 2, ...
/// v_c, the velocity after cycle c, is compared with the exact one at that cycle's end, as the paper's numbers need.
[[nodiscard]] double velocity_error(const std::vector<double>& velocity, double step);
}  // namespace hdem::verification
