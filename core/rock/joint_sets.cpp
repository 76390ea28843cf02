#include "core/rock/joint_sets.h"

#include "core/geometry/unit_direction.h"

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

double tangent_of(double deviation_deg)
{
    const Vec2 deviation = unit_direction(deviation_deg);
    return deviation_deg > 0.0 ? deviation.y() / deviation.x() : 0.0;
}

/// From the mean, of a law that dip_within_reach has cut [deg].
double greatest_deviation(const DistributionDef& law)
{
    return std::max(law.mean - *law.least, *law.most - law.mean);
}

JointTraces undrawn(const JointSetDef& set, const Box& box)
{
    JointTraces traces;
    traces.origin = set.origin.value_or(Vec2(0.5 * (box.low + box.high)));
    traces.across = turned_left(unit_direction(set.dip_deg));
    traces.spacing = set.spacing;
    traces.tilt = tangent_of(set.dip_law.is_random() ? greatest_deviation(dip_within_reach(set)) : set.deviation_deg);
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
    if (!positions.empty())
    {
        const double slack = 1e-9 * (std::abs(range.low) + std::abs(range.high) + spacing);
        const auto from = std::lower_bound(positions.begin(), positions.end(), range.low - slack);
        const auto to = std::upper_bound(positions.begin(), positions.end(), range.high + slack);
        return {static_cast<Index>(from - positions.begin()), static_cast<Index>(to - positions.begin())};
    }
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

DistributionDef dip_within_reach(const JointSetDef& set)
{
    DistributionDef law = set.dip_law;
    if (law.kind == DistributionKind::uniform && !(law.least && law.most))
    {
        law.least = law.mean - std::sqrt(3.0) * law.sd;
        law.most = law.mean + std::sqrt(3.0) * law.sd;
        law.sd = 0.0;
    }
    law.least = std::max(law.least.value_or(law.mean - most_deviation_deg), law.mean - most_deviation_deg);
    law.most = std::min(law.most.value_or(law.mean + most_deviation_deg), law.mean + most_deviation_deg);
    return law;
}

DipSource::DipSource(const JointSetDef& set, const DistributionDef& law, std::uint64_t seed) : set_(set), engine_(seed)
{
    if (law.is_random())
        law_.emplace(law);
}

double DipSource::draw()
{
    if (law_)
        return law_->draw(engine_);
    return set_.dip_deg + (set_.deviation_deg > 0.0 ? set_.deviation_deg * deviation_(engine_) : 0.0);
}

double count_joints(const JointSetDef& set, const Box& box)
{
    const JointTraces traces = undrawn(set, box);
    const Reach range = reach(corners(box), traces.origin, traces.across, traces.tilt);
    if (set.spacing_law.is_random())  // those between the origin and the box are drawn too
        return (std::max(range.high, 0.0) - std::min(range.low, 0.0)) / set.spacing + 1.0;
    return std::floor(range.high / set.spacing) - std::ceil(range.low / set.spacing) + 1.0;
}

namespace
{
/// Positions in a range that joints have by drawn spacings; the number of the first one.
std::int64_t draw_positions(const JointSetDef& set, std::int32_t number, const GeneratorDef& generator, const Reach& range,
                            std::vector<double>& positions)
{
    const Distribution law(set.spacing_law);
    boost::random::mt19937_64 up(stream_seed(generator, set, number, RandomUse::spacing_up));
    boost::random::mt19937_64 down(stream_seed(generator, set, number, RandomUse::spacing_down));
    std::int64_t first = 0;
    for (double at = -law.draw(down); at >= range.low; at -= law.draw(down))
    {
        --first;
        if (at <= range.high)
            positions.push_back(at);
    }
    std::reverse(positions.begin(), positions.end());
    std::int64_t skipped = 0;
    for (double at = 0.0; at <= range.high; at += law.draw(up))
    {
        if (at >= range.low)
            positions.push_back(at);
        else
            ++skipped;
    }
    return skipped > 0 ? skipped : first;
}
}  // namespace

JointTraces draw_joints(const JointSetDef& set, std::int32_t number, const GeneratorDef& generator, const Box& box)
{
    JointTraces traces = undrawn(set, box);
    traces.set = traces.source = number;
    const Reach range = reach(corners(box), traces.origin, traces.across, traces.tilt);
    DipSource dip(set, set.dip_law.is_random() ? dip_within_reach(set) : set.dip_law,
                  stream_seed(generator, set, number, RandomUse::dip));
    const auto add = [&](double position)
    {
        traces.dips.push_back(dip.draw());
        traces.lines.push_back({traces.origin + traces.across * position, unit_direction(traces.dips.back())});
    };
    if (set.spacing_law.is_random())
    {
        traces.first = draw_positions(set, number, generator, range, traces.positions);
        std::for_each(traces.positions.begin(), traces.positions.end(), add);
    }
    else
    {
        traces.first = static_cast<std::int64_t>(std::ceil(range.low / set.spacing));
        const auto last = static_cast<std::int64_t>(std::floor(range.high / set.spacing));
        for (std::int64_t i = traces.first; i <= last; ++i)
            add(static_cast<double>(i) * set.spacing);
    }
    if (set.dip_law.is_random())
    {
        double most = 0.0;
        for (const double drawn : traces.dips)
            most = std::max(most, std::abs(drawn - set.dip_deg));
        traces.tilt = tangent_of(most) * (1.0 + 1e-12);
    }
    return traces;
}
}  // namespace hdem
