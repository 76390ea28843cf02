#include "core/geometry/polygon.h"
#include "verification/unit/block_pair.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace hdem
{
namespace
{
using test::BlockPair;
using test::number;

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>, false, false>;

/// Both where they are drawn: pair_scene puts b 100 m aside.
BlockPair as_drawn(const Polygon& a, const Polygon& b)
{
    BlockPair pair(test::pair_scene(a, b));
    pair.motion(pair.b).x -= 100.0;
    return pair;
}

/// About the origin.
Polygon turned(Polygon shape, double degrees)
{
    const Vec2 x(std::cos(radians(degrees)), std::sin(radians(degrees)));
    for (Vec2& p : shape)
        p = p.x() * x + p.y() * turned_left(x);
    return shape;
}

/// Left and right exchanged.
Polygon mirrored(Polygon shape)
{
    for (Vec2& p : shape)
        p.x() = -p.x();
    std::ranges::reverse(shape);
    return shape;
}

double force_between(BlockPair& pair)
{
    pair.search();
    pair.evaluate();
    return pair.force(pair.b).norm();
}

double deepest_overlap(const BlockPair& pair)
{
    double deepest = 0.0;
    for (Index i = 0; i < pair.state.contacts.size(); ++i)
        if (const EdgeTouch touch = pair.touch(pair.state.contacts.get(i)); touch.length > 0.0)
            deepest = std::max({deepest, touch.point[0].overlap, touch.point[1].overlap});
    return deepest;
}

/// Two fallen blocks of a tunnel. The left one is cut at its hollow below into four parts; the rightmost is a thin ear on the side of its neighbour.
TEST(ConcaveBlock, DoesNotPressBehindAThinEar)
{
    const Polygon hollow{{16.0011194, 13.8583852}, {15.2860910, 12.6361148}, {15.4209748, 12.6777426},
                         {16.2984542, 12.7684405}, {17.1767673, 12.6862080}, {17.2828804, 12.6545768}};
    const Polygon neighbour{{17.1042066, 12.9088012}, {18.3524352, 12.7321636}, {18.1477010, 13.4820464}, {17.0491339, 12.9111379}};
    BlockPair apart = as_drawn(hollow, neighbour);  // by 28 mm
    EXPECT_EQ(force_between(apart), 0.0);

    // Through the ear and 10 mm into the part behind it: pressed out by that much, not by the 0.2 m to the floor below.
    BlockPair pressed = as_drawn(hollow, neighbour);
    pressed.motion(pressed.b).x -= 0.15;
    pressed.search();
    const double deepest = deepest_overlap(pressed);
    EXPECT_GT(deepest, 0.05);
    EXPECT_LT(deepest, 0.11);
}

/// The tip of a spike in a face that ends in a hollow corner, near this corner. It is pressed by the face, not by the corner across its own side: there the block goes on.
TEST(ConcaveBlock, DoesNotPressWithAHollowCorner)
{
    const Polygon roof{{-2.0, 0.62}, {0.0, 0.0}, {0.2, -0.11}, {0.4, 1.6}, {-2.0, 1.6}};
    const Polygon spike{{-0.01, 0.03}, {-0.205, -0.43}, {0.09, -0.57}};
    for (const double turn : {0.0, 37.0, 200.0})
    {
        const Vec2 x(std::cos(radians(turn)), std::sin(radians(turn)));
        BlockPair pair = as_drawn(turned(roof, turn), turned(spike, turn));
        pair.search();
        double deepest = 0.0;
        for (Index i = 0; i < pair.state.contacts.size(); ++i)
            if (const EdgeTouch touch = pair.touch(pair.state.contacts.get(i)); touch.length > 0.0)
            {
                const double overlap = std::max(touch.point[0].overlap, touch.point[1].overlap);
                if (overlap > 0.0)
                {
                    EXPECT_GT(std::abs(touch.ex * x.x() + touch.ey * x.y()), 0.9) << "turned by " << turn;
                }
                deepest = std::max(deepest, overlap);
            }
        EXPECT_NEAR(deepest, (0.03 - 0.0031) * 2.0 / std::hypot(2.0, 0.62), 1e-6);
    }
}

/// Both blocks turned by three angles, mirrored, and named the other way round: their deepest overlap.
void expect_overlap(const Polygon& a, const Polygon& b, double overlap)
{
    for (const double turn : {0.0, 37.0, 200.0})
    {
        BlockPair drawn = as_drawn(turned(a, turn), turned(b, turn));
        BlockPair other = as_drawn(turned(mirrored(a), turn), turned(mirrored(b), turn));
        BlockPair exchanged = as_drawn(turned(b, turn), turned(a, turn));
        for (BlockPair* const pair : {&drawn, &other, &exchanged})
        {
            pair->search();
            EXPECT_NEAR(deepest_overlap(*pair), overlap, 2e-4) << "turned by " << turn;
        }
    }
}

/// The tip of a spike beside a hollow corner, 8 mm behind a face and 5 mm behind the seam of two parts that begins in that corner. The part at the seam leaves it to the
/// part beyond, and no edge of that one lies over the tip: it bears itself, or the spike would go on through the block.
TEST(ConcaveBlock, BearsASpikeAtTheSeamOfTwoParts)
{
    const Polygon face{{-0.2265, -0.1158}, {-0.1793, -0.1139}, {0.2180, -0.1622},
                       {0.1911, -0.1198},  {0.0088, 0.2769},   {-0.0143, 0.2273}};
    const Polygon spike{{-0.1757, 0.6310}, {-0.2084, 0.5797}, {-0.4724, 0.2665},
                        {-0.4221, 0.2671}, {-0.0068, 0.2237}, {-0.0303, 0.2637}};
    expect_overlap(face, spike, 0.0083);
}

/// A spike that lies along one leg of an angle, with its tip 11.5 mm in the other leg and 9 mm behind the seam of both. The leg beyond the seam bears, but across the spike:
/// that does not hold the tip, and it would go on through the other leg.
TEST(ConcaveBlock, BearsASpikeInTheHollowOfAnAngle)
{
    const Polygon angle{{-0.2128, -0.6144}, {-0.0486, -0.7403}, {0.5777, 0.0762},
                        {-0.2388, 0.7024},  {-0.3648, 0.5382},  {0.2875, 0.0379}};
    const Polygon spike{{-1.5631, 0.6042}, {-1.2761, 0.2320}, {-1.1529, -0.7956}, {-0.1194, 0.0032},
                        {0.2967, 0.0310},  {-0.4364, 0.5932}, {-0.8344, 1.0880},  {-0.9912, 0.9493}};
    expect_overlap(angle, spike, 0.0115);
}

/// Steps that lie on a slab of their width. In a lower corner of each ends a seam, and the part beside the one with the lower face has only the upright side there. It must not bear: an edge at right
/// angles to what it lies on would push along it by a million times its normal force.
TEST(ConcaveBlock, BearsWithItsLowerFaceOnly)
{
    const Polygon slab{{0.0, -2.0}, {4.0, -2.0}, {4.0, 0.0}, {0.0, 0.0}};
    const std::vector<Polygon> steps{
        {{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {3.0, 1.0}, {3.0, 0.7}, {1.5, 0.7}, {1.5, 0.4}, {0.0, 0.4}},
        {{0.0, 0.0}, {4.0, 0.0}, {4.0, 0.5}, {0.5, 0.5}, {0.5, 2.0}, {0.0, 2.0}},
        {{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {2.0, 1.0}, {2.0, 0.6}, {0.0, 0.6}}};
    for (const Polygon& step : steps)
        for (const double turn : {0.0, 37.0, 200.0})
            for (const bool is_mirrored : {false, true})
                for (const double aside : {-1e-6, 1e-6})
                {
                    BlockPair pair = is_mirrored ? as_drawn(turned(mirrored(slab), turn), turned(mirrored(step), turn))
                                                 : as_drawn(turned(slab, turn), turned(step, turn));
                    const Vec2 x(std::cos(radians(turn)), std::sin(radians(turn)));
                    BlockMotion& m = pair.motion(pair.b);
                    const Vec2 moved = aside * x - 1e-5 * turned_left(x);
                    m.x += moved.x();
                    m.y += moved.y();
                    pair.search();
                    int pressed = 0;
                    for (Index i = 0; i < pair.state.contacts.size(); ++i)
                        if (const EdgeTouch touch = pair.touch(pair.state.contacts.get(i)); touch.length > 0.0)
                        {
                            EXPECT_NEAR(touch.length, 4.0, 1e-5);
                            ++pressed;
                        }
                    EXPECT_EQ(pressed, 1) << "turned by " << turn << ", mirrored " << is_mirrored << ", aside " << aside;
                }
}

/// A seam of two parts ends at the end of a foot. The part beside it has the inclined side there, and touches the ground with that corner alone. It must not bear:
/// it would press with half of that side's length.
TEST(ConcaveBlock, BearsWithItsFootAloneWhereASeamEndsAtItsEnd)
{
    const Polygon ground{{-20.0, -3.0}, {20.0, -3.0}, {20.0, 0.0}, {-20.0, 0.0}};
    const Polygon block{{0.162, 0.0}, {6.033, 0.776}, {3.895, 1.565}, {3.701, 1.383}, {3.014, 1.893}, {-2.987, 1.107}, {0.0, 0.0}};
    for (const double turn : {0.0, 37.0, 200.0})
        for (const bool is_mirrored : {false, true})
        {
            const auto placed = [&](const Polygon& shape) { return turned(is_mirrored ? mirrored(shape) : shape, turn); };
            BlockPair pair = as_drawn(placed(ground), placed(block));
            const Vec2 down = -1e-5 * turned_left(Vec2(std::cos(radians(turn)), std::sin(radians(turn))));
            BlockMotion& m = pair.motion(pair.b);
            m.x += down.x();
            m.y += down.y();
            pair.search();
            std::vector<double> pressed;
            for (Index i = 0; i < pair.state.contacts.size(); ++i)
                if (const EdgeTouch touch = pair.touch(pair.state.contacts.get(i));
                    touch.length > 0.0 && std::max(touch.point[0].overlap, touch.point[1].overlap) > 0.0)
                    pressed.push_back(touch.length);
            ASSERT_EQ(pressed.size(), 1U) << "turned by " << turn << ", mirrored " << is_mirrored;
            EXPECT_NEAR(pressed[0], 0.162, 1e-9);
        }
}

/// A hook above a bar that hangs on a stem: the top of the bar is one side in two pieces, and a lip of the hook is above each. Both are known before they land, or the hook
/// would land on one lip a cycle earlier and slip sideways.
TEST(ConcaveBlock, LandsOnBothPiecesOfASplitSideAtOnce)
{
    const Polygon bar{{-0.6, 0.7}, {0.6, 0.7}, {0.6, 1.0}, {0.1, 1.0}, {0.1, 2.0}, {-0.1, 2.0}, {-0.1, 1.0}, {-0.6, 1.0}};
    Polygon hook{{-1.0, 0.0}, {1.0, 0.0},  {1.0, 1.3},  {0.2, 1.3},  {0.2, 1.0},  {0.7, 1.0},
                 {0.7, 0.4},  {-0.7, 0.4}, {-0.7, 1.0}, {-0.2, 1.0}, {-0.2, 1.3}, {-1.0, 1.3}};
    for (Vec2& p : hook)
        p += Vec2(0.01, 0.005);
    for (const double turn : {0.0, 37.0, 200.0})
    {
        BlockPair pair = as_drawn(turned(bar, turn), turned(hook, turn));
        pair.search();
        std::vector<double> stretches;
        for (Index i = 0; i < pair.state.contacts.size(); ++i)
            if (const double length = pair.touch(pair.state.contacts.get(i)).length; length > 0.1)
                stretches.push_back(length);
        std::ranges::sort(stretches);
        ASSERT_EQ(stretches.size(), 2U) << "turned by " << turn;
        EXPECT_NEAR(stretches[0], 0.39, 1e-9);
        EXPECT_NEAR(stretches[1], 0.41, 1e-9);
    }
}

/// Convex but for a shallow hollow in each side, as rock is cut by arches: its parts have thin ears.
Polygon random_hollow()
{
    const Polygon convex = test::random_convex();
    Polygon hollow;
    for (std::size_t i = 0; i < convex.size(); ++i)
    {
        const Vec2 from = convex[i], way = convex[next(i, convex.size())] - from;
        hollow.push_back(from);
        hollow.emplace_back(from + number(0.1, 0.9) * way + number(0.01, 0.15) * turned_left(way));
    }
    return hollow;
}

BoostPolygon whole(const BlockPair& pair, Index block, const Polygon& drawn)
{
    BoostPolygon outline;
    const Vec2 centroid = area_moments(drawn).centroid;
    for (const Vec2& p : drawn)
    {
        const Vec2 at = BlockPair::world(pair.state.blocks.motion[block], p - centroid);
        bg::append(outline.outer(), bg::model::d2::point_xy<double>(at.x(), at.y()));
    }
    return outline;
}

/// Two parts of blocks that have come `way` into each other can be drawn apart by so much: none of their points may be pressed by more. (Up to 0.05 m: of blocks that
/// are three times as deep in each other one in 5000 is pressed out on the far side.)
RC_GTEST_PROP(ConcaveBlock, IsPressedByNoMoreThanTheWayIntoIt, ())
{
    const Polygon a = random_hollow(), b = *rc::gen::element(0, 1) == 0 ? random_hollow() : test::random_convex();
    for (const Polygon& shape : {a, b})
    {
        BoostPolygon ring;
        for (const Vec2& p : shape)
            bg::append(ring.outer(), bg::model::d2::point_xy<double>(p.x(), p.y()));
        RC_PRE(bg::is_valid(ring));  // no hollow reaches the other side
    }
    BlockPair pair(test::pair_scene(a, b));
    pair.place(pair.a, {0.0, 0.0}, number(-3.0, 3.0));
    const double angle = number(-3.0, 3.0), way = number(0.0, 0.05);
    const auto place = [&](double distance, double direction)
    { pair.place(pair.b, distance * Vec2(std::cos(direction), std::sin(direction)), angle); };
    for (const double direction : {0.1, 1.1, 2.1, 3.1, 4.1, 5.1})
    {
        double near = 0.0, far = 4.0;
        for (int i = 0; i < 40; ++i)
        {
            const double middle = 0.5 * (near + far);
            place(middle, direction);
            (bg::intersects(whole(pair, pair.a, a), whole(pair, pair.b, b)) ? near : far) = middle;
        }
        place(far - way, direction);
        pair.state.contacts.resize(0);
        pair.search();
        const double size = std::min(pair.model.size(pair.a), pair.model.size(pair.b));
        RC_ASSERT(deepest_overlap(pair) <= way + 1e-3 * size);  // margin of the choice of edges
    }
}
}  // namespace
}  // namespace hdem
