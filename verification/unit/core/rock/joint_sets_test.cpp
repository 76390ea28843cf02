#include "core/geometry/unit_direction.h"
#include "core/rock/joint_sets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hdem
{
namespace
{
const Box box = {{0.0, 0.0}, {35.0, 33.0}};

JointSetDef joint_set(double dip_deg, double spacing, double deviation_deg)
{
    JointSetDef set;
    set.dip_deg = dip_deg;
    set.spacing = spacing;
    set.deviation_deg = deviation_deg;
    return set;
}

TEST(JointTraces, AreSpacedAcrossThemAndOnePassesThroughTheOrigin)
{
    JointSetDef set = joint_set(30.0, 1.7, 0.0);
    set.origin = Vec2(3.0, 4.0);
    const JointTraces traces = draw_joints(set, 0, {}, box);
    double least = 1e9;
    for (std::size_t i = 0; i < traces.lines.size(); ++i)
    {
        EXPECT_EQ(traces.lines[i].direction, unit_direction(30.0));
        least = std::min(least, std::abs(traces.lines[i].side(*set.origin)));
        if (i > 0)
        {
            EXPECT_NEAR(traces.lines[i - 1].side(traces.lines[i].point), 1.7, 1e-13);
        }
    }
    EXPECT_LT(least, 1e-14);
}

TEST(JointTraces, PassThroughTheCentreOfTheBoxByDefault)
{
    const JointTraces traces = draw_joints(joint_set(70.0, 1.7, 2.0), 0, {}, box);
    const CutLine& joint_0 = traces.lines[static_cast<std::size_t>(-traces.first)];
    EXPECT_EQ(joint_0.point, Vec2(17.5, 16.5));
}

TEST(JointTraces, CoverTheWholeBox)
{
    for (const double dip : {0.0, 17.0, 45.0, 90.0, -75.0, 133.0})
    {
        const JointTraces traces = draw_joints(joint_set(dip, 2.0, 0.0), 0, {}, box);
        // One spacing beyond the first and last joint lies no corner any more.
        for (const Vec2& corner : {box.low, box.high, Vec2(box.low.x(), box.high.y()), Vec2(box.high.x(), box.low.y())})
        {
            EXPECT_GT(traces.lines.front().side(corner), -2.0 - 1e-12) << dip;
            EXPECT_LT(traces.lines.back().side(corner), 2.0 + 1e-12) << dip;
        }
    }
}

TEST(JointTraces, DeviateUniformly)
{
    const JointTraces traces = draw_joints(joint_set(10.0, 0.01, 2.0), 0, {}, box);
    double sum = 0.0;
    double squares = 0.0;
    for (const CutLine& line : traces.lines)
    {
        const double off = std::atan2(line.direction.y(), line.direction.x()) * 180.0 / 3.14159265358979 - 10.0;
        EXPECT_LE(std::abs(off), 2.0 + 1e-12);
        sum += off;
        squares += off * off;
    }
    const auto n = static_cast<double>(traces.lines.size());
    ASSERT_GT(n, 3000.0);
    const double deviation = 2.0 / std::sqrt(3.0);  // of a uniform distribution on ± 2
    EXPECT_NEAR(sum / n, 0.0, 5.0 * deviation / std::sqrt(n));
    EXPECT_NEAR(squares / n, deviation * deviation, 5.0 * 1.2 / std::sqrt(n));
}

TEST(JointTraces, OfASetDoNotDependOnOtherSetsButOnNumberAndSeed)
{
    const JointSetDef set = joint_set(10.0, 1.0, 2.0);
    const auto directions = [&](const JointSetDef& s, std::int32_t number, std::uint64_t seed)
    {
        GeneratorDef generator;
        generator.seed = seed;
        std::vector<Vec2> out;
        for (const CutLine& line : draw_joints(s, number, generator, box).lines)
        {
            out.push_back(line.direction);
        }
        return out;
    };
    EXPECT_EQ(directions(set, 0, 1), directions(set, 0, 1));
    EXPECT_NE(directions(set, 0, 1), directions(set, 1, 1));
    EXPECT_NE(directions(set, 0, 1), directions(set, 0, 2));
    JointSetDef own = set;
    own.seed = 5;
    EXPECT_EQ(directions(own, 0, 1), directions(own, 3, 2));
    EXPECT_NE(stream_seed({}, set, 0, RandomUse::dip), stream_seed({}, set, 0, RandomUse::persistence));
}

TEST(JointTraces, NearAPolygonAreAllThatTouchIt)
{
    const JointTraces traces = draw_joints(joint_set(-75.0, 0.5, 5.0), 0, {}, box);
    std::size_t looked_at = 0;
    std::size_t touching = 0;
    for (int i = 0; i < 400; ++i)
    {
        const Vec2 at = {1.7 * (i % 20), 1.6 * (i / 20)};
        const Polygon polygon = {at, at + Vec2(1.0, 0.1), at + Vec2(0.3, 0.9)};
        const IndexRange near = traces.near(polygon);
        looked_at += static_cast<std::size_t>(near.size());
        for (std::size_t k = 0; k < traces.lines.size(); ++k)
        {
            if (side_of(polygon, traces.lines[k], 1e-9) == Side::crossed)
            {
                ++touching;
                EXPECT_GE(static_cast<Index>(k), near.begin);
                EXPECT_LT(static_cast<Index>(k), near.end);
            }
        }
    }
    EXPECT_GT(touching, 400u);
    EXPECT_LT(looked_at, 12 * touching) << "few others";
}
}  // namespace
}  // namespace hdem
