#include "core/rock/joint_sets.h"

#include "core/geometry/unit_direction.h"

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Steele, Lea, Flood 2014: one step of splitmix64.
std::uint64_t splitmix64(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31U);
}

/// The joints that may touch a set of points, as numbers i (not rounded).
struct Reach
{
    double low;
    double high;
};

/// A joint deviates from its undeviated line by at most tilt times the distance from the spacing axis.
Reach reach(const Polygon& points, const Vec2& origin, const Vec2& across, double tilt)
{
    double low = across.dot(points.front() - origin);
    double high = low;
    double off_axis = 0.0;
    for (const Vec2& p : points)
    {
        const double position = across.dot(p - origin);
        low = std::min(low, position);
        high = std::max(high, position);
        off_axis = std::max(off_axis, std::abs(cross(across, p - origin)));
    }
    return {low - tilt * off_axis, high + tilt * off_axis};
}

JointTraces undrawn(const JointSetDef& set, const Box& box)
{
    JointTraces traces;
    traces.origin = set.origin.value_or(Vec2(0.5 * (box.low + box.high)));
    traces.across = turned_left(unit_direction(set.dip_deg));
    traces.spacing = set.spacing;
    const Vec2 deviation = unit_direction(set.deviation_deg);
    traces.tilt = set.deviation_deg > 0.0 ? deviation.y() / deviation.x() : 0.0;
    return traces;
}

Polygon corners(const Box& box)
{
    return {box.low, {box.high.x(), box.low.y()}, box.high, {box.low.x(), box.high.y()}};
}
}  // namespace

IndexRange JointTraces::near(const Polygon& polygon) const
{
    const Reach range = reach(polygon, origin, across, tilt);
    // One more on each side: the bounds carry round-off.
    const double low = std::floor(range.low / spacing) - 1.0 - static_cast<double>(first);
    const double high = std::ceil(range.high / spacing) + 2.0 - static_cast<double>(first);
    const double size = static_cast<double>(lines.size());
    return {static_cast<Index>(std::clamp(low, 0.0, size)), static_cast<Index>(std::clamp(high, 0.0, size))};
}

std::uint64_t stream_seed(const GeneratorDef& generator, const JointSetDef& set, std::int32_t number, RandomUse use)
{
    const std::uint64_t own = splitmix64(splitmix64(generator.seed) + static_cast<std::uint64_t>(number) + 1);
    return splitmix64(set.seed.value_or(own) + (static_cast<std::uint64_t>(use) << 32U));
}

double count_joints(const JointSetDef& set, const Box& box)
{
    const JointTraces traces = undrawn(set, box);
    const Reach range = reach(corners(box), traces.origin, traces.across, traces.tilt);
    return std::floor(range.high / set.spacing) - std::ceil(range.low / set.spacing) + 1.0;
}

JointTraces draw_joints(const JointSetDef& set, std::int32_t number, const GeneratorDef& generator, const Box& box)
{
    JointTraces traces = undrawn(set, box);
    traces.set = traces.source = number;
    const Reach range = reach(corners(box), traces.origin, traces.across, traces.tilt);
    traces.first = static_cast<std::int64_t>(std::ceil(range.low / set.spacing));
    const auto last = static_cast<std::int64_t>(std::floor(range.high / set.spacing));

    boost::random::mt19937_64 engine(stream_seed(generator, set, number, RandomUse::dip));
    boost::random::uniform_real_distribution<double> deviation(-1.0, 1.0);
    for (std::int64_t i = traces.first; i <= last; ++i)
    {
        const double off_deg = set.deviation_deg > 0.0 ? set.deviation_deg * deviation(engine) : 0.0;
        const Vec2 point = traces.origin + traces.across * (static_cast<double>(i) * set.spacing);
        traces.lines.push_back({point, unit_direction(set.dip_deg + off_deg)});
    }
    return traces;
}
}  // namespace hdem
