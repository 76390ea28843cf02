#include "core/motion/tipping.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Of the radius: points so near to each other are one.
constexpr double one_point = 0.01;

/// A closed end of a contact, as the block sees it.
struct Bearing
{
    Vec2 at = {0.0, 0.0};     ///< from the centroid [m]
    Vec2 other = {0.0, 0.0};  ///< the other end of the contact [m]
    Vec2 force = {0.0, 0.0};  ///< on the block [N]
    bool opens = false;       ///< the faces turn away from each other
};

/// @param w  of the block, or of its group [rad/s]
Bearing bearing_of(Index block, double w, Index contact, int end, const EdgeTouch& touch, const ContactTies& ties)
{
    const Contacts& contacts = ties.contacts;
    const bool is_ref = contacts.ref[contact] == block;
    const auto place = [&](const TouchPoint& p) -> Vec2
    {
        const double t = is_ref ? p.ref_t : p.inc_t, m = is_ref ? p.ref_m : p.inc_m;
        return {touch.ex * t - touch.ey * m, touch.ey * t + touch.ex * m};
    };
    const double turn = ties.blocks.motion[ties.other_block(block, contact)].w - w;
    const double shear = contacts.shear_force(end, contact) + contacts.tilt_force(end, contact),
                 normal = contacts.normal_force(end, contact);
    const Vec2 on_inc(shear * touch.ex + normal * touch.ey, shear * touch.ey - normal * touch.ex);
    return {.at = place(touch.point[end]),
            .other = place(touch.point[1 - end]),
            .force = is_ref ? Vec2(-on_inc) : on_inc,
            .opens = touch.slope * (is_ref ? turn : -turn) > 0.0};
}

/// A group as one rigid block.
struct Whole
{
    Vec2 centroid = {0.0, 0.0};
    double w = 0.0;       ///< angular momentum about the centroid over moment of inertia [rad/s]
    double radius = 0.0;  ///< of its largest member [m]
};

Whole whole_of(const std::vector<Index>& group, const Model& model, const Blocks& blocks)
{
    const BlockMotion& origin = blocks.motion[group.front()];
    if (group.size() == 1)
        return {{origin.x, origin.y}, origin.w, model.radius[group.front()]};
    Whole whole;
    double mass = 0.0, momentum = 0.0, inertia = 0.0;
    Vec2 place = Vec2::Zero(), velocity = Vec2::Zero();  // from the origin
    for (const Index block : group)
    {
        const BlockMotion& m = blocks.motion[block];
        const double of_block = model.mass[block], rotary = 1.0 / blocks.inertia[block].inverse_inertia;
        const Vec2 from(m.x - origin.x, m.y - origin.y), moves(m.vx - origin.vx, m.vy - origin.vy);
        mass += of_block;
        place += of_block * from;
        velocity += of_block * moves;
        momentum += of_block * cross(from, moves) + rotary * m.w;
        inertia += of_block * from.squaredNorm() + rotary;
        whole.radius = std::max(whole.radius, model.radius[block]);
    }
    place /= mass;
    whole.centroid = Vec2(origin.x, origin.y) + place;
    whole.w = (momentum - cross(place, velocity)) / (inertia - mass * place.squaredNorm());
    return whole;
}

/// Takes one after the other the points that bear a group.
class TippingTest
{
  public:
    TippingTest(const Whole& whole, const Vec2& gravity, bool may_roll) : whole_(whole), gravity_(gravity), may_roll_(may_roll) {}

    /// @return whether the group may tip, by what is known now
    bool take(Index contact, Tie tie, const Bearing& bearing)
    {
        if (!turns_on(bearing.at) || (!bearing.opens && !(may_roll_ && turns_on(bearing.other))))
            return false;
        if (first_ == no_index)
            hinge_ = bearing.at;
        const bool is_apart = first_ != no_index && (hinge_ - bearing.at).norm() > one_point * whole_.radius;
        if (is_apart && !(may_roll_ && first_ == contact))
            return false;
        rolls_ = rolls_ || is_apart;
        first_ = first_ == no_index ? contact : first_;
        sticks_ = sticks_ || tie == Tie::sticks;
        stuck_ += (tie == Tie::sticks ? 1.0 : -1.0) * bearing.force.norm();
        moment_ += cross(bearing.at, bearing.force);
        return true;
    }

    [[nodiscard]] bool is_passed() const
    {
        return first_ != no_index && (rolls_ ? stuck_ > 0.0 : sticks_ || moment_ * whole_.w > 0.0);
    }

  private:
    [[nodiscard]] bool turns_on(const Vec2& at) const { return cross(gravity_, at) * whole_.w > 0.0; }

    const Whole& whole_;
    Vec2 gravity_;
    bool may_roll_;
    Index first_ = no_index;  ///< contact
    Vec2 hinge_ = Vec2::Zero();
    double moment_ = 0.0;
    double stuck_ = 0.0;  ///< of the forces, more than slides [N]
    bool sticks_ = false, rolls_ = false;
};
}  // namespace

bool tips(const std::vector<Index>& group, const Model& model, const GroupRule& rule, const ContactTies& ties)
{
    const Whole whole = whole_of(group, model, ties.blocks);
    if (!(std::abs(whole.w) * whole.radius > rule.speed))
        return false;
    TippingTest test(whole, model.gravity, !rule.seeks_rest && group.size() == 1);
    const auto fails = [&](Index block, Index contact, int end, const EdgeTouch& touch)
    {
        const Tie tie = ties.at(contact, end);
        if (tie == Tie::none)
            return false;
        Bearing bearing = bearing_of(block, whole.w, contact, end, touch, ties);
        const Vec2 from_whole = Vec2(ties.blocks.motion[block].x, ties.blocks.motion[block].y) - whole.centroid;
        bearing.at += from_whole;
        bearing.other += from_whole;
        return !test.take(contact, tie, bearing);
    };
    for (const Index block : group)
        if (ties.any_contact(block,
                             [&](Index contact, Index other)
                             {
                                 if (!ties.do_touch(contact) || std::ranges::binary_search(group, other))
                                     return false;
                                 const EdgeTouch touch = ties.touch(contact);
                                 return fails(block, contact, 0, touch) || fails(block, contact, 1, touch);
                             }))
            return false;
    return test.is_passed();
}
}  // namespace hdem
