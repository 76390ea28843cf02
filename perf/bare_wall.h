#pragma once
/// The wall of the yardsticks: bricks 2 m x 1 m in running bond between fixed sides, under the stress of hdem's wall; six contact points a brick, all of them closed.

#include "core/types.h"

#include <array>
#include <vector>

namespace hdem::perf
{
struct BareWall
{
    static constexpr double normal_stiffness = 3.5e9;  ///< of a point: half a metre of a joint of 7e9 Pa/m [N/m]
    static constexpr double shear_stiffness = 2.5e8;   ///< [N/m]
    static constexpr double friction = 0.57735;
    static constexpr double density = 2700.0;  ///< [kg/m3]
    static constexpr double mass = 2.0 * density;
    static constexpr double inertia = mass * (2.0 * 2.0 + 1.0) / 12.0;
    static constexpr double damping = 0.7;  ///< local damping

    /// Two points of brick a on an edge of brick b.
    struct Contact
    {
        Index a, b;
        std::array<double, 2> x, y;    ///< of the points, from the centroid of a [m]
        std::array<double, 2> normal;  ///< of the edge, towards a
        std::array<double, 2> along;   ///< from the centroid of b to the first point [m]
        double offset;  ///< of the edge from the centroid of b, so that the points are pressed as they are at rest [m]
    };

    /// `side` courses of `side` bricks, at rest under their weight.
    explicit BareWall(Index side);

    double gravity;                                ///< [m/s2]
    double step;                                   ///< [s]
    std::vector<std::array<double, 2>> centroids;  ///< the last one is fixed: floor, sides and the half bricks at them [m]
    std::vector<Contact> contacts;

    [[nodiscard]] Index fixed() const { return static_cast<Index>(centroids.size()) - 1; }

  private:
    void lay_course(Index course, Index side);
    void add(Index a, Index b, const std::array<double, 2>& x, const std::array<double, 2>& y, const std::array<double, 2>& normal,
             double force);
};
}  // namespace hdem::perf
