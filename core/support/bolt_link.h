#pragma once
/// Where the two ends of a link are, and what its spring holds.

#include "core/model/model.h"

namespace hdem
{
struct LinkPlace
{
    Vec2 first, second;     ///< the two ends [m]
    Vec2 axis;              ///< the bolt's direction, turned with both blocks [-]
    Vec2 line;              ///< from the first end to the second; the axis where they are the same [-]
    double distance = 0.0;  ///< of the ends [m]
    double across = 0.0;    ///< the part of it square to the axis, to the left [m]
};

[[nodiscard]] inline Vec2 turned_with(const BlockMotion& m, const Vec2& v)
{
    return {m.c * v.x() - m.s * v.y(), m.s * v.x() + m.c * v.y()};
}

[[nodiscard]] inline LinkPlace place_of(const Bolt& bolt, const BoltLink& link, const Blocks& blocks)
{
    const BlockMotion& a = blocks.motion[link.first];
    const BlockMotion& b = blocks.motion[link.second];
    LinkPlace at;
    at.first = Vec2(a.x, a.y) + turned_with(a, link.first_arm);
    at.second = Vec2(b.x, b.y) + turned_with(b, link.second_arm);
    const Vec2 sum = turned_with(a, bolt.axis) + turned_with(b, bolt.axis);
    const double size = sum.norm();
    at.axis = size > 1e-9 ? Vec2(sum / size) : turned_with(a, bolt.axis);
    const Vec2 apart = at.second - at.first;
    at.distance = apart.norm();
    at.line = at.distance > 0.0 ? Vec2(apart / at.distance) : at.axis;
    at.across = apart.dot(turned_left(at.axis));
    return at;
}

/// Energy of a spring [J/m].
[[nodiscard]] inline double energy_in(double force, double stiffness)
{
    return stiffness > 0.0 ? 0.5 * force * force / stiffness : 0.0;
}
}  // namespace hdem
