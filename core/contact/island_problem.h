#pragma once
/// Impulses of points that share blocks, to be found all at once.

#include "core/contact/impulse_kick.h"
#include "core/state/blocks.h"
#include "core/state/workspace.h"

#include <vector>

namespace hdem
{
/// Velocity by which a point breaks its law [m/s]:
///
///   |J' - J| / m_cN,     J' = max(0, J + m_cN (v_m - target))            [Lee2025] Eqs. (15)-(18)
///   |J_S' - J_S| / m_cS, J_S' = J_S - m_cS v_t, |J_S'| <= J tan(phi) + c    [Lee2025] Eqs. (9), (10)
///
/// whichever is greater; 0: a sweep would not change the point's impulses.
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

    /// Gives points other impulses, and their blocks the velocities that follow from them.
    void set_impulses(const std::vector<double>& normal, const std::vector<double>& shear);
};
}  // namespace hdem
