#include "core/detection/edge_touch.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace hdem
{
namespace
{
/// Upper edge of a block 4 m x 2 m, seen from its centroid: it runs from right to left, m points down into the block.
EdgePair faces(const Vec2& p0, const Vec2& p1)
{
    EdgePair e{.tx = -1.0, .ty = 0.0, .length = 4.0, .p0x = p0.x(), .p0y = p0.y(), .p1x = p1.x(), .p1y = p1.y()};
    const Vec2 t(e.tx, e.ty), start(2.0, 1.0);
    e.start_t = t.dot(start);
    e.start_m = cross(t, start);
    return e;
}

EdgeTouch touch(const EdgePair& e, const BlockMotion& ref, const BlockMotion& inc)
{
    return touch_edges(e, ref, inc);
}

/// Lower edge of a unit square.
const EdgePair square_on_slab = faces({-0.5, -0.5}, {0.5, -0.5});

TEST(EdgeTouch, OfAFlatSquareHasItsWidthAndDepth)
{
    const EdgeTouch t = touch(square_on_slab, {}, {.x = 0.3, .y = 1.5 - 1e-5});
    EXPECT_NEAR(t.length, 1.0, 1e-15);
    for (const TouchPoint& p : t.point)
        EXPECT_NEAR(p.overlap, 1e-5, 1e-15);
    EXPECT_EQ(t.ex, -1.0);
    // t runs to the left: the lower t is the right end.
    EXPECT_NEAR(t.point[0].inc_t, -0.5, 1e-15);
    EXPECT_NEAR(t.point[1].inc_t, 0.5, 1e-15);
    EXPECT_NEAR(t.point[0].ref_t, -0.8, 1e-15);
}

TEST(EdgeTouch, OfAnOverhangingSquareIsClippedAtTheEdgesEnd)
{
    const EdgeTouch t = touch(square_on_slab, {}, {.x = 2.2, .y = 1.5});
    EXPECT_NEAR(t.length, 0.3, 1e-15);
    EXPECT_NEAR(t.point[0].ref_t, -2.0, 1e-15) << "the slab's corner";
}

TEST(EdgeTouch, OfASquareBesideTheEdgeHasNoLength)
{
    const EdgeTouch t = touch(square_on_slab, {}, {.x = 2.7, .y = 1.4});
    EXPECT_LE(t.length, 0.0);
    EXPECT_FALSE(is_closed(t.length, t.point[0].overlap, 1e-3));
    EXPECT_FALSE(is_closed(t.length, t.point[1].overlap, 1e-3));
}

TEST(EdgeTouch, OfATiltedSquareFollowsTheSlope)
{
    const double angle = 0.1;
    // Turned about its lower left corner, which lies 1e-4 m deep at x = 0.
    const Vec2 centre = Vec2(0.0, 1.0 - 1e-4) +
                        Vec2(0.5 * std::cos(angle) - 0.5 * std::sin(angle), 0.5 * std::sin(angle) + 0.5 * std::cos(angle));
    const EdgeTouch t = touch(square_on_slab, {}, {.x = centre.x(), .y = centre.y(), .c = std::cos(angle), .s = std::sin(angle)});
    EXPECT_NEAR(t.length, std::cos(angle), 1e-15);
    EXPECT_NEAR(t.point[1].overlap, 1e-4, 1e-15);
    EXPECT_NEAR(t.point[0].overlap, 1e-4 - std::sin(angle), 1e-15);
}

TEST(EdgeTouch, OfAnEdgeAcrossTheReferenceEdgeIsFinite)
{
    const EdgeTouch t = touch(square_on_slab, {}, {.x = 0.0, .y = 1.0, .c = 0.0, .s = 1.0});
    EXPECT_TRUE(std::isfinite(t.length) && std::isfinite(t.point[0].overlap) && std::isfinite(t.point[1].overlap));
}

BlockMotion moved(BlockMotion m, double dt)
{
    m.x += m.vx * dt;
    m.y += m.vy * dt;
    m.angle += m.w * dt;
    m.c = std::cos(m.angle);
    m.s = std::sin(m.angle);
    return m;
}

/// Deep, tilted, both blocks turning; one point is the reference edge's end, the other a vertex.
TEST(TurningRate, IsHowVelocitiesChangeWhileBlocksKeepTheirs)
{
    const BlockMotion ref = moved({.x = 0.1, .y = -0.2, .vx = 3.0, .vy = -2.0, .w = 4.0}, 0.02);
    const BlockMotion inc = moved({.x = 2.0, .y = 1.2, .vx = -5.0, .vy = -7.0, .w = 11.0}, 0.02);
    constexpr double h = 1e-6;
    const auto after = [&](double dt) { return touch(square_on_slab, moved(ref, dt), moved(inc, dt)); };
    const EdgeTouch now = after(0.0), before = after(-h), later = after(h);
    EXPECT_GT(std::abs(now.slope), 0.1);
    EXPECT_NE(now.point[0].inside < 0.0, now.point[1].inside < 0.0);
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint &p = now.point[k], &b = before.point[k], &l = later.point[k];
        const TurningRate<double> rate(p, now.slope, ref.w, inc.w);
        EXPECT_GT(std::abs(p.overlap), 0.05);
        EXPECT_NEAR(rate.t, (l.v_t - b.v_t) / (2.0 * h), 1e-5) << k;
        EXPECT_NEAR(rate.m, (l.v_m - b.v_m) / (2.0 * h), 1e-5) << k;
        EXPECT_NEAR(rate.surface, (surface_velocity(l, ref.w, inc.w) - surface_velocity(b, ref.w, inc.w)) / (2.0 * h), 1e-5) << k;
    }
}

TEST(ClosedContact, AllowsForRoundingOfTouchingFacesOnly)
{
    EXPECT_TRUE(is_closed(1.0, 0.0, 1e-3));
    EXPECT_TRUE(is_closed(1.0, -0.9e-9, 1e-3));
    EXPECT_FALSE(is_closed(1.0, -1.1e-9, 1e-3));
    EXPECT_FALSE(is_closed(0.0, 1.0, 1e-3));
}

TEST(PointLength, IsHalfTheContactButNotLessThanHalfTheFloor)
{
    EXPECT_DOUBLE_EQ(point_length(0.8, 1e-3), 0.4);
    EXPECT_NEAR(point_length(1e-9, 1e-3), 0.5e-3, 1e-15);
}

TEST(PointLength, AndItsGrowthHaveNoJump)
{
    constexpr double f = 1e-3, h = 1e-9;
    EXPECT_DOUBLE_EQ(point_length(2.0 * f, f), f);
    EXPECT_EQ(length_growth(-f, f), 0.0);
    EXPECT_EQ(length_growth(3.0 * f, f), 1.0);
    for (double l = 0.05 * f; l < 3.0 * f; l += 0.1 * f)
        EXPECT_NEAR(length_growth(l, f), (point_length(l + h, f) - point_length(l - h, f)) / h, 1e-6) << l;
}

struct RandomTouch
{
    EdgePair edges;
    BlockMotion ref, inc;
};

double number(double low, double high)
{
    return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1000001);
}

RandomTouch random_touch()
{
    const double angle = number(-0.5, 0.5), turn = number(-3.0, 3.0);
    RandomTouch r{square_on_slab, {}, {}};
    const Vec2 along(std::cos(turn), std::sin(turn));
    const Vec2 at = number(-1.2, 1.2) * along + number(1.2, 1.5) * turned_left(along);
    r.ref = {.x = 3.0, .y = -2.0, .c = along.x(), .s = along.y(), .vx = number(-1, 1), .vy = number(-1, 1), .w = number(-1, 1)};
    r.inc = {.x = 3.0 + at.x(),
             .y = -2.0 + at.y(),
             .c = std::cos(turn + angle),
             .s = std::sin(turn + angle),
             .vx = number(-1, 1),
             .vy = number(-1, 1),
             .w = number(-1, 1)};
    return r;
}

BlockMotion later(BlockMotion m, double dt)
{
    const double c = std::cos(m.w * dt), s = std::sin(m.w * dt);
    m.x += m.vx * dt;
    m.y += m.vy * dt;
    const double old = m.c;
    m.c = m.c * c - m.s * s;
    m.s = m.s * c + old * s;
    return m;
}

RC_GTEST_PROP(EdgeTouch, ArmsFromBothCentroidsLeadToTheSamePoint, ())
{
    const RandomTouch r = random_touch();
    const EdgeTouch t = touch(r.edges, r.ref, r.inc);
    const Vec2 axis(t.ex, t.ey);
    for (const TouchPoint& p : t.point)
    {
        const Vec2 from_ref = Vec2(r.ref.x, r.ref.y) + p.ref_t * axis + p.ref_m * turned_left(axis);
        const Vec2 from_inc = Vec2(r.inc.x, r.inc.y) + p.inc_t * axis + p.inc_m * turned_left(axis);
        RC_ASSERT((from_ref - from_inc).norm() < 1e-14);
        // Halfway between the surfaces: the reference edge is at m = start_m.
        RC_ASSERT(std::abs(p.ref_m - r.edges.start_m - 0.5 * p.overlap) < 1e-14);
    }
}

/// Material points of both blocks at the contact point move apart as (v_t, v_m) says: central differences, dt = 1e-6.
RC_GTEST_PROP(EdgeTouch, RelativeVelocityIsThatOfTheMaterialPoints, ())
{
    const RandomTouch r = random_touch();
    const EdgeTouch t = touch(r.edges, r.ref, r.inc);
    const Vec2 axis(t.ex, t.ey);
    constexpr double dt = 1e-6;
    const auto velocity_of = [&](const BlockMotion& m, double along, double across)
    {
        const Vec2 arm = along * axis + across * turned_left(axis);
        const Vec2 body(m.c * arm.x() + m.s * arm.y(), m.c * arm.y() - m.s * arm.x());
        const auto place = [&](const BlockMotion& at)
        { return Vec2(at.x + at.c * body.x() - at.s * body.y(), at.y + at.s * body.x() + at.c * body.y()); };
        return Vec2((place(later(m, dt)) - place(later(m, -dt))) / (2.0 * dt));
    };
    for (const TouchPoint& p : t.point)
    {
        const Vec2 v = velocity_of(r.inc, p.inc_t, p.inc_m) - velocity_of(r.ref, p.ref_t, p.ref_m);
        // Round-off 1e-15 m / dt of coordinates of some metres; the truncation is 1e-12.
        RC_ASSERT(std::abs(v.dot(axis) - p.v_t) < 1e-8);
        RC_ASSERT(std::abs(v.dot(turned_left(axis)) - p.v_m) < 1e-8);
    }
}

/// At a vertex of the incident edge, v_m is the rate of the overlap.
RC_GTEST_PROP(EdgeTouch, OverlapOfAVertexGrowsWithTheApproachVelocity, ())
{
    const RandomTouch r = random_touch();
    const EdgeTouch now = touch(r.edges, r.ref, r.inc);
    constexpr double dt = 1e-6;
    const auto overlap_at = [&](double time, int vertex)
    {
        const EdgeView v = view_edges(r.edges, later(r.ref, time), later(r.inc, time));
        return vertex == 0 ? v.m0 : v.m1;
    };
    const EdgeView v = view_edges(r.edges, r.ref, r.inc);
    RC_PRE(v.t0 > 0.0 && v.t0 < 4.0 && v.t1 > 0.0 && v.t1 < 4.0);
    for (int vertex = 0; vertex < 2; ++vertex)
    {
        const bool lower = (v.t0 < v.t1) == (vertex == 0);
        const double rate = (overlap_at(dt, vertex) - overlap_at(-dt, vertex)) / (2.0 * dt);
        RC_ASSERT(std::abs(rate - now.point[lower ? 0 : 1].v_m) < 1e-8);  // as above
    }
}
}  // namespace
}  // namespace hdem
