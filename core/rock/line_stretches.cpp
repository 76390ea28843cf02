#include "core/rock/line_stretches.h"

#include "core/rock/fault_lines.h"

#include <algorithm>

namespace hdem
{
void add_crossings(const Polygon& line, bool is_closed, const Vec2& from, const Vec2& to, std::vector<double>& shares)
{
    const Vec2 way = to - from;
    const std::size_t edges = line.size() - (is_closed ? 0 : 1);
    for (std::size_t i = 0; i < edges; ++i)
    {
        const Vec2& a = line[i];
        const Vec2& b = line[next(i, line.size())];
        const double side_a = cross(way, a - from), side_b = cross(way, b - from);
        if ((side_a > 0.0) == (side_b > 0.0))
            continue;
        const Vec2 at = a + (b - a) * (side_a / (side_a - side_b));
        const double share = way.dot(at - from) / way.squaredNorm();
        if (share > 0.0 && share < 1.0)
            shares.push_back(share);
    }
}

double length_inside(const Polygon& domain, const Vec2& from, const Vec2& to)
{
    std::vector<double> shares = {0.0, 1.0};
    add_crossings(domain, true, from, to, shares);
    std::sort(shares.begin(), shares.end());
    double inside = 0.0;
    for (std::size_t i = 1; i < shares.size(); ++i)
        if (contains(domain, from + 0.5 * (shares[i - 1] + shares[i]) * (to - from)))
            inside += shares[i] - shares[i - 1];
    return inside * (to - from).norm();
}

std::vector<Stretch> find_stretches(const CaseDef& def, const Regions& regions, const JointSetDef& set, const Polygon& domain,
                                    const Vec2& from, const Vec2& to)
{
    const Vec2 way = to - from;
    double first = 0.0, last = 1.0;
    std::vector<double> shares;
    for (const FaultDef& fault : def.faults)
        if (std::ranges::find(set.stops_at, fault.name) != set.stops_at.end())
            add_crossings(fault.points, false, from, to, shares);
    for (const double share : shares)
        (share <= 0.5 ? first : last) = share <= 0.5 ? std::max(first, share) : std::min(last, share);
    shares = {first, last};
    regions.add_boundaries(set, from, to, shares);
    std::erase_if(shares, [&](double share) { return share < first || share > last; });
    std::sort(shares.begin(), shares.end());

    const double slack = line_slack(domain) / way.norm();
    std::vector<Stretch> stretches;
    for (std::size_t i = 1; i < shares.size(); ++i)
    {
        std::size_t end = i;
        while (end < shares.size() && regions.is_meant(set, Vec2(from + 0.5 * (shares[end - 1] + shares[end]) * way)))
            ++end;
        if (end == i)
            continue;
        const double begins = shares[i - 1], ends = shares[end - 1];
        i = end;
        if (!(begins < ends))
            continue;
        const Vec2 a = from + (begins > 0.0 ? begins - slack : 0.0) * way;
        const Vec2 b = from + (ends < 1.0 ? ends + slack : 1.0) * way;
        stretches.push_back({a, b, length_inside(domain, from + begins * way, from + ends * way)});
    }
    return stretches;
}
}  // namespace hdem
