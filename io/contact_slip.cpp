#include "io/contact_slip.h"

#include <cmath>

namespace hdem
{
namespace
{
/// How far the rock of a block that is now at `place` has moved since the stage began [m].
Vec2 displacement_at(const Blocks& blocks, Index block, const Vec2& place)
{
    const BlockMotion& now = blocks.motion[block];
    const Vec2 arm = place - Vec2(now.x, now.y);
    const double turn = now.angle - blocks.reference_angle[block];
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return blocks.displacement(block) + arm - Vec2(c * arm.x() + s * arm.y(), c * arm.y() - s * arm.x());
}
}  // namespace

double slip_of(const Blocks& blocks, const ContactReport& contact)
{
    const Vec2 middle = 0.5 * (contact.point[0] + contact.point[1]);
    const Vec2 moved = displacement_at(blocks, contact.second, middle) - displacement_at(blocks, contact.first, middle);
    return -moved.dot(contact.shear_axis());
}
}  // namespace hdem
