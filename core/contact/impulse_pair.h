#pragma once
/// Normal impulses of one contact point, and of the two points of a contact together.

#include "core/contact/impulse_kick.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
/// Normal impulse of a point by itself.
[[nodiscard]] inline double single_normal(const ImpulsePoint& p, const Blocks& blocks)
{
    const double v_m = relative_velocity(p, blocks.motion[p.ref], blocks.motion[p.inc]).m;
    return std::max(0.0, p.impulse_normal + p.mass_normal * (v_m - p.target));
}

/// Normal impulses of two points that stop the same motion: the blocks can only part, or only turn against each other about one axis. The effects of the two
/// impulses then differ by a factor only.
/// @param k  what a unit impulse does at a, at b, and at the other one [1/kg]
/// @param r  approach velocities beyond the targets if neither point had an impulse yet [m/s]
[[nodiscard]] inline std::array<double, 2> one_motion_normal(const ImpulsePoint& a, const ImpulsePoint& b,
                                                             const std::array<double, 3>& k, const std::array<double, 2>& r)
{
    const auto& [k_a, k_b, k_ab] = k;
    if (k_ab > 0.0)  // both stop it: only a sum is known, and each change is shared
    {
        constexpr double alike = 1e-3;  // blocks that cannot turn, or a contact so short that its points are as good as one
        const double ratio = std::abs(k_b - k_a) <= alike * k_a ? 1.0 : std::sqrt(k_b / k_a), share = 1.0 / (1.0 + ratio * ratio);
        const double change = share * (std::max(r[0], r[1] / ratio) / k_a - a.impulse_normal - ratio * b.impulse_normal);
        return {std::max(0.0, a.impulse_normal + change), std::max(0.0, b.impulse_normal + ratio * change)};
    }
    // On both sides of the axis: what takes one of them out of the joint presses the other one in. None bounces farther than the other allows.
    return {std::max(0.0, std::min(r[0] / k_a, r[1] / k_ab)), std::max(0.0, std::min(r[1] / k_b, r[0] / k_ab))};
}

/// Normal impulses of the two points of one contact, solved together: with one of them the other's velocity changes too.
[[nodiscard]] inline std::array<double, 2> pair_normal(const ImpulsePoint& a, const ImpulsePoint& b, const Blocks& blocks)
{
    const BlockMotion& ref = blocks.motion[a.ref];
    const BlockMotion& inc = blocks.motion[a.inc];
    const double k_a = 1.0 / a.mass_normal;
    const double k_b = 1.0 / b.mass_normal;
    const double k_ab = a.coupling;
    // Approach velocities beyond the targets if neither had an impulse yet.
    const double r_a = relative_velocity(a, ref, inc).m - a.target + k_a * a.impulse_normal + k_ab * b.impulse_normal;
    const double r_b = relative_velocity(b, ref, inc).m - b.target + k_ab * a.impulse_normal + k_b * b.impulse_normal;
    const double det = k_a * k_b - k_ab * k_ab;
    if (det <= 1e-9 * k_a * k_b)
        return one_motion_normal(a, b, {k_a, k_b, k_ab}, {r_a, r_b});
    const std::array<double, 2> both{(k_b * r_a - k_ab * r_b) / det, (k_a * r_b - k_ab * r_a) / det};
    if (both[0] >= 0.0 && both[1] >= 0.0)
        return both;
    const double only_a = std::max(0.0, r_a / k_a);
    if (r_b - k_ab * only_a <= 0.0)
        return {only_a, 0.0};
    return {0.0, std::max(0.0, r_b / k_b)};
}
}  // namespace hdem
