#include "core/rock/fault_lines.h"

#include "core/geometry/polygon.h"
#include "core/geometry/unit_direction.h"
#include "core/model/edge_sources.h"
#include "core/rock/rock_checks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace hdem
{
namespace
{
/// Stretches that are there already.
class Stretches
{
  public:
    explicit Stretches(double near) : near_(near) {}

    void add(const Vec2& from, const Vec2& to) { ends_.push_back({from, to}); }

    /// Do both points lie on one of them?
    [[nodiscard]] bool hold(const Vec2& a, const Vec2& b) const
    {
        return std::any_of(ends_.begin(), ends_.end(), [&](const Ends& on) { return holds(on, a) && holds(on, b); });
    }

    /// Points of an edge from a on, without b: those at which stretches end that it runs along.
    [[nodiscard]] Polygon parted(const Vec2& a, const Vec2& b) const
    {
        const Ends edge{a, b};
        const Vec2 way = b - a;
        std::vector<std::pair<double, Vec2>> points{{0.0, a}};
        const auto is_apart = [&](const Vec2& p, const Vec2& q) { return (p - q).norm() > near_; };
        for (const Ends& on : ends_)
            for (const auto& [end, other] : {std::pair(on.from, on.to), std::pair(on.to, on.from)})
            {
                const bool is_within = holds(edge, end) && is_apart(end, a) && is_apart(end, b);
                if (is_within && ((holds(edge, other) && is_apart(end, other)) || holds(on, a) || holds(on, b)))
                    points.emplace_back(way.dot(end - a), end);
            }
        std::ranges::stable_sort(points, {}, &std::pair<double, Vec2>::first);
        Polygon line;
        for (const auto& [at, point] : points)
            if (line.empty() || is_apart(point, line.back()))
                line.push_back(point);
        return line;
    }

  private:
    struct Ends
    {
        Vec2 from;
        Vec2 to;
    };

    [[nodiscard]] bool holds(const Ends& on, const Vec2& p) const
    {
        const double length = (on.to - on.from).norm();
        const Vec2 along = (on.to - on.from) / length;
        const double t = along.dot(p - on.from);
        return std::abs(cross(along, p - on.from)) <= near_ && t >= -near_ && t <= length + near_;
    }

    double near_;
    std::vector<Ends> ends_;
};

/// A line whose ends are to lie beyond what they meet.
/// @param keeps_first, keeps_last  others have these points, too: they stay, and what is beyond comes in addition
Polygon lengthened(const Polygon& line, double by, bool keeps_first, bool keeps_last)
{
    const Vec2 first = line.front() - line[1];
    const Vec2 last = line.back() - line[line.size() - 2];
    Polygon out{line.front() + by * first / first.norm()};
    out.insert(out.end(), line.begin() + (keeps_first ? 0 : 1), line.end() - (keeps_last ? 0 : 1));
    out.push_back(line.back() + by * last / last.norm());
    return out;
}

class LineCollector
{
  public:
    explicit LineCollector(const Polygon& domain) : slack_(line_slack(domain)), known_(0.1 * slack_)
    {
        for (std::size_t i = 0; i < domain.size(); ++i)
            known_.add(domain[i], domain[next(i, domain.size())]);
    }

    /// The stretches of a line that are new. A ring begins anywhere.
    void add(std::int32_t source, const Polygon& given, bool is_ring)
    {
        Polygon points;
        for (std::size_t i = 0; i + (is_ring ? 0 : 1) < given.size(); ++i)
            std::ranges::copy(known_.parted(given[i], given[next(i, given.size())]), std::back_inserter(points));
        if (!is_ring)
            points.push_back(given.back());
        const std::size_t n = points.size();
        const std::size_t edges = is_ring ? n : n - 1;
        const auto is_old = [&](std::size_t edge) { return known_.hold(points[edge % n], points[(edge + 1) % n]); };
        std::size_t first = 0;
        while (is_ring && first < edges && !is_old(first))
            ++first;
        if (is_ring && first == edges)
        {
            lines_.push_back({source, points});
            lines_.back().points.push_back(points.front());
        }
        else
            add_chains(source, points, first, edges, is_old);
        for (std::size_t edge = 0; edge < edges; ++edge)
            known_.add(points[edge], points[(edge + 1) % n]);
    }

    /// Chains are made longer, so that round-off does not part them from what they meet.
    [[nodiscard]] std::vector<SourceLine> take()
    {
        const auto place = [](const Vec2& p) { return std::pair(p.x(), p.y()); };
        const auto is_ring = [](const SourceLine& line) { return line.points.front() == line.points.back(); };
        std::map<std::pair<double, double>, int> lines_at;
        for (const SourceLine& line : lines_)
            for (std::size_t i = is_ring(line) ? 1 : 0; i < line.points.size(); ++i)
                ++lines_at[place(line.points[i])];
        const auto is_shared = [&](const Vec2& p) { return lines_at.at(place(p)) > 1; };
        for (SourceLine& line : lines_)
            if (!is_ring(line))
                line.points = lengthened(line.points, slack_, is_shared(line.points.front()), is_shared(line.points.back()));
        return std::move(lines_);
    }

  private:
    template <class IsOld>
    void add_chains(std::int32_t source, const Polygon& points, std::size_t first, std::size_t edges, const IsOld& is_old)
    {
        Polygon chain;
        const auto end_chain = [&]
        {
            if (!chain.empty())
                lines_.push_back({source, std::move(chain)});
            chain.clear();
        };
        for (std::size_t edge = first; edge < first + edges; ++edge)
        {
            if (is_old(edge))
            {
                end_chain();
                continue;
            }
            if (chain.empty())
                chain.push_back(points[edge % points.size()]);
            chain.push_back(points[(edge + 1) % points.size()]);
        }
        end_chain();
    }

    double slack_;
    Stretches known_;
    std::vector<SourceLine> lines_;
};

/// Where the straight way from `from` along a unit vector leaves the circle of radius r around `centre`. @pre from is inside
Vec2 at_circle(const Vec2& from, const Vec2& direction, const Vec2& centre, double r)
{
    const Vec2 out = from - centre;
    const double along = out.dot(direction);
    return from + direction * (-along + std::sqrt(along * along - out.squaredNorm() + r * r));
}
}  // namespace

double line_slack(const Polygon& domain)
{
    const Box box = bounding_box(domain);
    return 1e-6 * (box.high - box.low).norm();
}

std::vector<SourceLine> source_lines(const CaseDef& def)
{
    LineCollector lines(domain_polygon(def.domain));
    for (std::size_t i = 0; i < def.faults.size(); ++i)
        lines.add(EdgeSources::fault(i), def.faults[i].points, false);
    for (std::size_t i = 0; i < def.regions.size(); ++i)
        if (!def.regions[i].polygon.empty())
            lines.add(EdgeSources(def).region(i), def.regions[i].polygon, true);
    return lines.take();
}

bool has_above(const FaultDef& fault)
{
    const Vec2 way = fault.points.back() - fault.points.front();
    return std::abs(way.x()) > 1e-9 * way.norm();
}

Polygon area_above(const FaultDef& fault, const Polygon& domain)
{
    Polygon line = fault.points;
    if (line.back().x() < line.front().x())
        std::reverse(line.begin(), line.end());
    Polygon all = domain;
    all.insert(all.end(), line.begin(), line.end());
    const Box box = bounding_box(all);
    const Vec2 centre = 0.5 * (box.low + box.high);
    const double r = 2.0 * (box.high - box.low).norm();
    Polygon area = {at_circle(line.front(), (line.front() - line[1]).normalized(), centre, r)};
    area.insert(area.end(), line.begin(), line.end());
    area.push_back(at_circle(line.back(), (line.back() - line[line.size() - 2]).normalized(), centre, r));
    // Back to the start along the circle, anticlockwise: so the area on the left of the line is enclosed.
    const Vec2 from = area.back() - centre;
    const Vec2 to = area.front() - centre;
    const double angle = std::atan2(cross(from, to), from.dot(to));
    const double sweep_deg = (angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi) * 180.0 / std::numbers::pi;
    const int steps = 2 + static_cast<int>(sweep_deg / 15.0);
    for (int i = 1; i < steps; ++i)
    {
        const Vec2 turn = unit_direction(sweep_deg * i / steps);
        area.push_back(centre + Vec2(turn.x() * from.x() - turn.y() * from.y(), turn.y() * from.x() + turn.x() * from.y()));
    }
    return area;
}
}  // namespace hdem
