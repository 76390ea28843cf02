#pragma once
/// Impulses of points that share blocks, to be found all at once.

#include "core/contact/impulse_kick.h"
#include "core/joint/coulomb_slip.h"
#include "core/state/blocks.h"
#include "core/state/workspace.h"

#include <algorithm>
#include <vector>

namespace hdem
{
/// Impulses that a sweep would give the point, each by itself [N s]:
///
///   J' = max(0, J + m_cN (v_m - target))                [Lee2025] Eqs. (15)-(18)
///   J_S' = J_S - m_cS v_t, |J_S'| <= J tan(phi) + c      [Lee2025] Eqs. (9), (10)
[[nodiscard]] inline double next_normal(const ImpulsePoint& point, const PointVelocity& velocity)
{
    return point.mass_normal > 0.0 ? std::max(point.impulse_normal + point.mass_normal * (velocity.m - point.target), 0.0)
                                   : point.impulse_normal;
}
[[nodiscard]] inline double next_shear(const ImpulsePoint& point, const PointVelocity& velocity)
{
    return slip_limited(point.impulse_shear - point.mass_shear * velocity.t, shear_limit(point, point.impulse_normal));
}

/// Velocity by which a point breaks its law [m/s]: |J' - J| / m_cN or |J_S' - J_S| / m_cS, whichever is greater. 0: a sweep would not change the
/// point's impulses.
[[nodiscard]] double law_error(const ImpulsePoint& point, const PointVelocity& velocity);

/// Points that share blocks, and their blocks.
struct IslandProblem
{
    struct Block
    {
        BlockInertia inertia;
        Triple velocity;
    };
    std::vector<Block> blocks;
    std::vector<ImpulsePoint> points;  ///< ref and inc are positions in `blocks`; velocities hold their impulses already

    [[nodiscard]] PointVelocity velocity_at(const ImpulsePoint& point) const
    {
        const Triple& ref = blocks[point.ref].velocity;
        const Triple& inc = blocks[point.inc].velocity;
        return relative_velocity(point, inc.x - ref.x, inc.y - ref.y, ref, inc);
    }

    /// Greatest law_error of its points [m/s].
    [[nodiscard]] double error() const;

    /// Greatest normal impulse of all points [N s].
    [[nodiscard]] double greatest_impulse() const;

    /// Greatest mass of a block that can move [kg].
    [[nodiscard]] double heaviest() const;

    /// Impulse that could stop the heaviest block, or the greatest normal impulse of now if that is greater [N s].
    [[nodiscard]] double stopping_impulse() const;

    /// Greatest normal impulse that a solution may have, 1e4 times stopping_impulse() [N s]. A wedge that jams can be held by arbitrarily great impulses,
    /// or by none at all; in the ledger, those of 1e18 would leave no digits.
    [[nodiscard]] double impulse_bound() const { return 1e4 * stopping_impulse(); }

    /// Gives a point other impulses, and its blocks the velocities that follow from them.
    void set_impulses(ImpulsePoint& point, double normal, double shear);
    void set_impulses(const std::vector<double>& normal, const std::vector<double>& shear);
};
}  // namespace hdem
