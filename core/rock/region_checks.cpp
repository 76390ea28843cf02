#include "core/rock/region_checks.h"

#include "core/geometry/polygon.h"
#include "core/rock/fault_lines.h"
#include "core/rock/polygon_error.h"
#include "core/rock/problem_text.h"
#include "core/rock/rock_checks.h"

#include <algorithm>
#include <string>

namespace hdem
{
namespace
{
/// Every pair of a fault's edges is looked at.
constexpr std::size_t most_fault_points = 5'000;

/// Do two stretches have a point in common?
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const auto parts = [](const Vec2& from, const Vec2& to, const Vec2& p, const Vec2& q)
    {
        const double side_p = cross(to - from, p - from);
        const double side_q = cross(to - from, q - from);
        return (side_p >= 0.0 && side_q <= 0.0) || (side_p <= 0.0 && side_q >= 0.0);
    };
    const Box of_ab{a.cwiseMin(b), a.cwiseMax(b)};
    return of_ab.meets({c.cwiseMin(d), c.cwiseMax(d)}) && parts(a, b, c, d) && parts(c, d, a, b);
}

/// Value, reason and remedy; empty for a line that does not meet itself.
std::string line_error(const Polygon& points)
{
    if (points.size() < 2 || points.size() > most_fault_points)
        return std::to_string(points.size()) + " points (it takes 2 to " + std::to_string(most_fault_points) +
               "). Give the points in order along it.";
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (!points[i].allFinite())
            return "point " + std::to_string(i) + " = " + text(points[i]) + " (must be finite). Correct it.";
        if (i > 0 && points[i] == points[i - 1])
            return "points " + std::to_string(i - 1) + " and " + std::to_string(i) + " are the same, " + text(points[i]) +
                   " (a stretch has a length). Leave one out.";
    }
    for (std::size_t i = 1; i < points.size(); ++i)
        for (std::size_t j = 1; j < i; ++j)
        {
            const bool is_next = j + 1 == i;
            const Vec2 back = points[i] - points[i - 1];
            const bool folds = is_next && cross(points[j] - points[j - 1], back) == 0.0 &&
                               back.dot(points[j] - points[j - 1]) < 0.0;
            if (folds || (!is_next && meet(points[j - 1], points[j], points[i - 1], points[i])))
                return "the stretches from points " + std::to_string(j - 1) + " and " + std::to_string(i - 1) +
                       " meet (a fault must not cross itself). Give the points in order along it, or make two faults of it.";
        }
    return {};
}

bool touches(const Polygon& line, const Polygon& domain)
{
    for (std::size_t i = 1; i < line.size(); ++i)
        for (std::size_t j = 0; j < domain.size(); ++j)
            if (meet(line[i - 1], line[i], domain[j], domain[next(j, domain.size())]))
                return true;
    return contains(domain, line.front());
}

class RegionChecker
{
  public:
    explicit RegionChecker(const CaseDef& def) : def_(def) {}

    std::vector<Problem> run()
    {
        for (std::size_t i = 0; i < def_.faults.size(); ++i)
            check_fault(def_.faults[i], "fault[" + std::to_string(i) + "]");
        for (std::size_t i = 0; i < def_.regions.size(); ++i)
            check_region(def_.regions[i], "region[" + std::to_string(i) + "]");
        return std::move(problems_);
    }

  private:
    void fail(const std::string& key, const std::string& text) { problems_.push_back({.key = key, .text = text}); }

    void check_fault(const FaultDef& fault, const std::string& at)
    {
        const std::string object = "fault \"" + fault.name + "\": points: ";
        if (const std::string error = line_error(fault.points); !error.empty())
            return fail(at + ".points", object + error);
        if (!def_.domain.given)
            return;
        const Polygon domain = domain_polygon(def_.domain);
        const Box box = bounding_box(domain);
        if (!touches(fault.points, domain))
            fail(at + ".points", object + "from " + text(fault.points.front()) + " to " + text(fault.points.back()) +
                                     " (the fault lies outside the domain, which spans " + text(box.low) + " to " + text(box.high) +
                                     "). Move it.");
    }

    void check_region(const RegionDef& region, const std::string& at)
    {
        const std::string object = "region \"" + region.name + "\": ";
        if (region.polygon.empty() && region.above.empty() && region.below.empty())
            fail(at, object + "polygon, above and below (none is given). Give at least one of them.");
        if (!region.polygon.empty())
            if (const std::string error = polygon_error(region.polygon); !error.empty())
                fail(at + ".polygon", object + "polygon: " + error);
        check_side(region.above, at + ".above", object + "above");
        check_side(region.below, at + ".below", object + "below");
    }

    void check_side(const std::string& name, const std::string& at, const std::string& said)
    {
        const auto fault = std::find_if(def_.faults.begin(), def_.faults.end(), [&](const FaultDef& f) { return f.name == name; });
        if (name.empty() || fault == def_.faults.end() || !line_error(fault->points).empty() || !def_.domain.given)
            return;
        const std::string what = said + " = \"" + name + "\" ";
        if (!has_above(*fault))
            fail(at, what + "(the fault ends straight above its beginning: no side is the upper one). Give the side as a polygon "
                            "along the fault.");
        else if (find_self_crossing(area_above(*fault, domain_polygon(def_.domain))))
            fail(at, what + "(the fault winds: with its ends made longer it crosses itself). Give the side as a polygon along the "
                            "fault.");
    }

    const CaseDef& def_;
    std::vector<Problem> problems_;
};
}  // namespace

std::vector<Problem> find_region_problems(const CaseDef& def)
{
    return RegionChecker(def).run();
}
}  // namespace hdem
