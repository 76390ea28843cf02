#pragma once
/// A block's pose turned by a finite angle.

#include "core/geometry/unit_direction.h"
#include "core/state/blocks.h"

#include <numbers>

namespace hdem
{
/// @param angle  [rad]
inline void turn_by(double angle, BlockMotion& pose)
{
    pose.angle += angle;
    const Vec2 turned = unit_direction(angle * 180.0 / std::numbers::pi);
    const Vec2 axis = Vec2(pose.c * turned.x() - pose.s * turned.y(), pose.s * turned.x() + pose.c * turned.y()).normalized();
    pose.c = axis.x();
    pose.s = axis.y();
}
}  // namespace hdem
