#include "io/profile.h"

#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace hdem
{
namespace
{
constexpr std::size_t most_points = 20'000;

bool take_row(std::string_view line, Vec2& point)
{
    const auto comma = line.find(',');
    if (comma == std::string_view::npos)
        return false;
    Scanner x{trimmed(line.substr(0, comma))}, y{trimmed(line.substr(comma + 1))};
    return x.take_number(point.x()) && x.rest.empty() && y.take_number(point.y()) && y.rest.empty();
}
}  // namespace

ProfileFile read_profile(std::istream& in, const std::string& file_name)
{
    ProfileFile result;
    const auto complain = [&](int line, const std::string& why)
    {
        result.problems.push_back(
            {Problem::Severity::error, "domain.profile", fmt::format("{}:{}: profile: line ({}", file_name, line, why)});
    };
    bool is_first = true;
    const auto add = [&](int line, std::string_view text)
    {
        Vec2 point;
        const bool is_heading = std::exchange(is_first, false);
        if (!take_row(text, point))
        {
            if (!is_heading)
                complain(line, fmt::format("expected two finite numbers, got \"{}\"). Write x,y with points as decimal marks.",
                                           printable(text, 40)));
        }
        else if (point.cwiseAbs().maxCoeff() > farthest_coordinate)
            complain(line, fmt::format("the point is farther than {} m from the origin). Move the model nearer to the origin.",
                                       farthest_coordinate));
        else if (!result.points.empty() && point.x() <= result.points.back().x())
            complain(line, fmt::format("x = {} does not follow {}). Give the points from the left to the right; for a wall that is "
                                       "upright or overhangs use domain.polygon.",
                                       point.x(), result.points.back().x()));
        else
            result.points.push_back(point);
        if (result.points.size() > most_points)
            complain(line, fmt::format("more than {} points). Leave some out.", most_points));
        return result.problems.empty();
    };
    int last = 0;
    if (const std::string why = read_lines(in, last, add); !why.empty())
        complain(last, why);
    if (result.points.size() < 2 && result.problems.empty())
        complain(last, fmt::format("the file has {} points). Give two at least.", result.points.size()));
    return result;
}

Polygon domain_below(const Polygon& profile, double bottom)
{
    Polygon domain = {{profile.front().x(), bottom}, {profile.back().x(), bottom}};
    domain.insert(domain.end(), profile.rbegin(), profile.rend());
    return domain;
}
}  // namespace hdem
