#pragma once
/// Plane polygons: area, centroid, second moment, convexity, simplicity, distance, overlap.
/// A polygon is not closed: its last edge runs from the last vertex to the first.
/// Every sum is formed relative to a vertex of the polygon itself, so that an offset of 1e6 m costs no digits of an area.

#include "core/types.h"

#include <optional>
#include <vector>

namespace hdem
{
struct Box
{
    Vec2 low = {0.0, 0.0};   ///< [m]
    Vec2 high = {0.0, 0.0};  ///< [m]

    [[nodiscard]] bool meets(const Box& other) const
    {
        return low.x() <= other.high.x() && other.low.x() <= high.x() && low.y() <= other.high.y() && other.low.y() <= high.y();
    }
};

/// What the mass properties of a plate of unit thickness need; times density they are mass and moment of inertia.
struct AreaMoments
{
    double area = 0.0;           ///< [m2]
    Vec2 centroid = {0.0, 0.0};  ///< [m]
    double polar = 0.0;          ///< ∫ |x - centroid|² dA [m4]
};

/// Two edges of one polygon that meet where they must not; edge i runs from vertex i to vertex i+1.
struct SelfCrossing
{
    std::size_t edge_a = 0;
    std::size_t edge_b = 0;
    Vec2 point = {0.0, 0.0};  ///< [m]
};

/// Position after i, with wrap-around.
[[nodiscard]] inline std::size_t next(std::size_t i, std::size_t size)
{
    return i + 1 == size ? 0 : i + 1;
}

/// Position before i, with wrap-around.
[[nodiscard]] inline std::size_t previous(std::size_t i, std::size_t size)
{
    return i == 0 ? size - 1 : i - 1;
}

/// 1/2 Σ (p_i - p_0) x (p_{i+1} - p_0), positive for anticlockwise order [m2].
double signed_area(const Polygon& polygon);

/// Area, centroid and polar second moment of a simple polygon of either orientation.
///
///   A = 1/2 Σ a x b,   c = p_0 + Σ (a x b)(a + b) / (6 A)            a = p_i - p_0,  b = p_{i+1} - p_0
///   J = 1/12 Σ (a x b)(|a|² + a·b + |b|²)                            a = p_i - c,    b = p_{i+1} - c
AreaMoments area_moments(const Polygon& polygon);

/// Moments of a union of areas that do not overlap: J = Σ (J_i + A_i |c_i - c|²).
AreaMoments combined(const std::vector<AreaMoments>& parts);

/// @pre polygon is not empty
Box bounding_box(const Polygon& polygon);

/// True when the order of the vertices was reversed.
bool make_anticlockwise(Polygon& polygon);

/// Sine of the turn from edge i-1 to edge i: positive at a convex vertex of an anticlockwise polygon, 0 on a straight edge.
double turn(const Polygon& polygon, std::size_t i);

/// Anticlockwise, and no vertex turns right by more than `slack` (sine of the angle: straight vertices carry round-off).
/// @pre the polygon is simple: a pentagram turns left everywhere too
bool is_convex(const Polygon& polygon, double slack = 1e-9);

/// The first pair of edges that cross, touch or fold back on each other; nothing for a simple polygon.
std::optional<SelfCrossing> find_self_crossing(const Polygon& polygon);

/// Even-odd rule; which way a point on the boundary goes is not specified.
bool contains(const Polygon& polygon, const Vec2& point);

/// Distance from a point to the polygon's boundary [m].
double distance_to_boundary(const Polygon& polygon, const Vec2& point);

/// Area common to two convex anticlockwise polygons, by clipping one with the edges of the other [m2].
double convex_overlap_area(const Polygon& a, const Polygon& b);
}  // namespace hdem
