#include "core/rock/fault_lines.h"

#include "core/geometry/polygon.h"
#include "core/geometry/unit_direction.h"
#include "core/model/edge_sources.h"
#include "core/rock/rock_checks.h"

#include <algorithm>
#include <cmath>

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

void lengthen(Polygon& line, double by)
{
    const Vec2 first = line.front() - line[1];
    const Vec2 last = line.back() - line[line.size() - 2];
    line.front() += by * first / first.norm();
    line.back() += by * last / last.norm();
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
    void add(std::int32_t source, const Polygon& points, bool is_ring)
    {
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

    [[nodiscard]] std::vector<SourceLine> take() { return std::move(lines_); }

  private:
    template <class IsOld>
    void add_chains(std::int32_t source, const Polygon& points, std::size_t first, std::size_t edges, const IsOld& is_old)
    {
        Polygon chain;
        const auto end_chain = [&]
        {
            if (!chain.empty())
            {
                lengthen(chain, slack_);
                lines_.push_back({source, std::move(chain)});
            }
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
