#include "verification/unit/block_pair.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace hdem
{
namespace
{
using test::BlockPair;
using test::number;

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>, false, false>;

BoostPolygon to_boost(const Polygon& polygon, const Vec2& shift = {0.0, 0.0})
{
    BoostPolygon result;
    for (const Vec2& p : polygon)
        bg::append(result.outer(), bg::model::d2::point_xy<double>(p.x() + shift.x(), p.y() + shift.y()));
    return result;
}

double common_area(const Polygon& a, const Polygon& b, const Vec2& shift)
{
    std::vector<BoostPolygon> common;
    bg::intersection(to_boost(a), to_boost(b, shift), common);
    double area = 0.0;
    for (const BoostPolygon& piece : common)
        area += bg::area(piece);
    return area;
}

BlockPair random_pair()
{
    return BlockPair(test::pair_scene(test::random_convex(), test::random_convex()));
}

/// Place b beside a so that they overlap by `overlap` along the direction of least overlap (negative: a gap). @return the contact.
Contact press(BlockPair& pair, double overlap)
{
    pair.place(pair.a, {0.0, 0.0}, number(-3.0, 3.0));
    const double direction = number(0.0, 6.28), angle = number(-3.0, 3.0);
    const Vec2 away(std::cos(direction), std::sin(direction));
    double near = 0.0, far = 10.0;  // distance grows with the way apart
    Contact contact;
    for (int i = 0; i < 100; ++i)
    {
        const double middle = 0.5 * (near + far);
        pair.place(pair.b, middle * away, angle);
        contact = {.part_a = pair.model.shapes.part_begin[pair.a], .part_b = pair.model.shapes.part_begin[pair.b]};
        (find_features(pair.model, pair.state.blocks, contact) < -overlap ? near : far) = middle;
    }
    return contact;
}

RC_GTEST_PROP(RandomManifold, PartsTouchIfAndOnlyIfTheirPolygonsIntersect, ())
{
    BlockPair pair = random_pair();
    pair.place(pair.a, {0.0, 0.0}, number(-3.0, 3.0));
    pair.place(pair.b, {number(-1.5, 1.5), number(-1.5, 1.5)}, number(-3.0, 3.0));
    Contact contact{.part_a = pair.model.shapes.part_begin[pair.a], .part_b = pair.model.shapes.part_begin[pair.b]};
    const double distance = find_features(pair.model, pair.state.blocks, contact);
    const Polygon a = pair.outline(pair.a), b = pair.outline(pair.b);
    const bool intersect = bg::intersects(to_boost(a), to_boost(b));
    RC_PRE(std::abs(distance) > 1e-3);  // nearer than that, the choice among nearly equal edges decides
    RC_ASSERT((distance < 0.0) == intersect);
    RC_ASSERT(pair.is_closed_at(contact) == intersect);
    if (!intersect)
        RC_ASSERT(distance <= bg::distance(to_boost(a), to_boost(b)) + 1e-12);  // a bound from below; round-off
}

/// The least way b must be pushed along the contact normal to come free is the overlap found; no contact point overlaps by more.
RC_GTEST_PROP(RandomManifold, NormalAndOverlapSeparateTheParts, ())
{
    BlockPair pair = random_pair();
    const double overlap = number(0.001, 0.1);
    const Contact contact = press(pair, overlap);
    const EdgeTouch touch = pair.touch(contact);
    // Near ties may prefer the edge whose overlap is larger by a tenth of the length floor (1e-3 of the smaller size).
    const double margin = 1e-4 * std::min(pair.model.size(pair.a), pair.model.size(pair.b));
    const double deepest = std::max(touch.point[0].overlap, touch.point[1].overlap);
    RC_ASSERT(touch.length > 0.0);
    RC_ASSERT(deepest <= overlap + margin + 1e-12);
    RC_ASSERT(deepest >= overlap - 1e-9);
    const Vec2 away = -turned_left(Vec2(touch.ex, touch.ey)) * (contact.inc == pair.b ? 1.0 : -1.0);
    const Polygon a = pair.outline(pair.a), b = pair.outline(pair.b);
    RC_ASSERT(common_area(a, b, (deepest + 1e-6) * away) < 1e-9);
    RC_ASSERT(bg::intersects(to_boost(a), to_boost(b, (overlap - margin - 1e-6) * away)));
}

/// Forces of a random pair with random velocities at the first touch.
struct Forces
{
    Vec2 on_a, on_b;
    double moment_a, moment_b;
};

Forces forces_of(BlockPair& pair, Contact contact, ContactLaw law)
{
    contact.ref_edge = contact.inc_edge = no_index;
    contact.point = {};
    find_features(pair.model, pair.state.blocks, contact);
    pair.state.contacts.resize(1);
    pair.state.contacts.put(0, contact);
    for (BlockForce& force : pair.state.blocks.force)  // closing springs ask for those of the last cycle
        force = {};
    pair.evaluate(law);
    return {pair.force(pair.a), pair.force(pair.b), pair.moment(pair.a), pair.moment(pair.b)};
}

BlockPair moving_pair(Contact& contact)
{
    BlockPair pair = random_pair();
    contact = press(pair, number(1e-5, 1e-3));
    for (const Index block : {pair.a, pair.b})
    {
        BlockMotion& m = pair.motion(block);
        m.vx = number(-1, 1);
        m.vy = number(-1, 1);
        m.w = number(-1, 1);
    }
    return pair;
}

/// Forces come from overlaps of 1e-5 m and more, known to 1e-15 m.
constexpr double rounding = 1e-9;

void assert_same(const Forces& one, const Forces& other)
{
    const double size = one.on_a.norm() + one.on_b.norm();
    RC_ASSERT((one.on_a - other.on_a).norm() <= rounding * size);
    RC_ASSERT((one.on_b - other.on_b).norm() <= rounding * size);
    RC_ASSERT(std::abs(one.moment_a - other.moment_a) <= rounding * size);
    RC_ASSERT(std::abs(one.moment_b - other.moment_b) <= rounding * size);
}

RC_GTEST_PROP(ContactForces, OfTwoBlocksAreOppositeInForceAndMoment, ())
{
    Contact contact;
    BlockPair pair = moving_pair(contact);
    const Forces f = forces_of(pair, contact, ContactLaw::springs);
    const double size = f.on_a.norm();
    RC_PRE(size > 0.0);  // one placement in some ten thousands: corners that pass each other bear nothing (corner_beside_corner.h)
    RC_ASSERT((f.on_a + f.on_b).norm() <= 1e-14 * size);  // the same number, added with both signs
    const auto about_origin = [&](Index block, const Vec2& force, double moment) {
        return moment + cross({pair.motion(block).x, pair.motion(block).y}, force);
    };
    RC_ASSERT(std::abs(about_origin(pair.a, f.on_a, f.moment_a) + about_origin(pair.b, f.on_b, f.moment_b)) <= 1e-13 * size);
}

RC_GTEST_PROP(ContactForces, TurnWithTheBlocks, ())
{
    Contact contact;
    BlockPair pair = moving_pair(contact);
    const Forces here = forces_of(pair, contact, ContactLaw::springs);
    const double angle = number(-3.0, 3.0);
    const Vec2 d(std::cos(angle), std::sin(angle));
    const auto turn = [&](const Vec2& v) { return Vec2(v.x() * d + v.y() * turned_left(d)); };
    for (const Index block : {pair.a, pair.b})
    {
        BlockMotion& m = pair.motion(block);
        const Vec2 x = turn({m.x, m.y}), r = turn({m.c, m.s}), v = turn({m.vx, m.vy});
        m = {.x = x.x(), .y = x.y(), .c = r.x(), .s = r.y(), .vx = v.x(), .vy = v.y(), .w = m.w, .angle = m.angle + angle};
    }
    assert_same(forces_of(pair, contact, ContactLaw::springs), {turn(here.on_a), turn(here.on_b), here.moment_a, here.moment_b});
}

RC_GTEST_PROP(ContactForces, DoNotDependOnWhichPartIsNamedFirst, ())
{
    Contact contact;
    BlockPair pair = moving_pair(contact);
    const Forces here = forces_of(pair, contact, ContactLaw::springs);
    std::swap(contact.part_a, contact.part_b);
    assert_same(forces_of(pair, contact, ContactLaw::springs), here);
}

RC_GTEST_PROP(ContactForces, MirrorWithTheBlocks, ())
{
    const Polygon shape_a = test::random_convex(), shape_b = test::random_convex();
    BlockPair pair(test::pair_scene(shape_a, shape_b));
    Contact contact = press(pair, number(1e-5, 1e-3));
    for (const Index block : {pair.a, pair.b})
        pair.motion(block).vx = number(-1, 1);
    const Forces here = forces_of(pair, contact, ContactLaw::springs);
    const auto mirror = [](Polygon p)
    {
        for (Vec2& v : p)
            v.x() = -v.x();
        return p;
    };
    BlockPair image(test::pair_scene(mirror(shape_a), mirror(shape_b)));
    for (const auto& [from, to] : {std::pair(pair.a, image.a), std::pair(pair.b, image.b)})
    {
        const BlockMotion m = pair.motion(from);
        image.motion(to) = {.x = -m.x, .y = m.y, .c = m.c, .s = -m.s, .vx = -m.vx, .vy = m.vy, .w = -m.w, .angle = -m.angle};
    }
    contact.part_a = image.model.shapes.part_begin[image.a];
    contact.part_b = image.model.shapes.part_begin[image.b];
    const auto flip = [](const Vec2& v) { return Vec2(-v.x(), v.y()); };
    assert_same(forces_of(image, contact, ContactLaw::springs), {flip(here.on_a), flip(here.on_b), -here.moment_a, -here.moment_b});
}
}  // namespace
}  // namespace hdem
