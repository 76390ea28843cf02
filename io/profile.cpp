#include "io/profile.h"

#include "io/csv_row.h"
#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <utility>

namespace hdem
{
namespace
{
constexpr std::size_t most_points = 20'000;

constexpr std::array<CsvColumn, 2> heading = {{{"x", "m"}, {"y", "m"}}};

bool take_row(std::span<const std::string> columns, Vec2& point)
{
    return columns.size() == 2 && read_csv_number(columns[0], point.x()) && read_csv_number(columns[1], point.y());
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
        const bool may_be_heading = std::exchange(is_first, false);
        const std::vector<std::string> columns = csv_columns(text);
        if (may_be_heading && columns.size() == heading.size() && is_csv_heading(columns, heading))
            return true;
        if (!take_row(columns, point))
            complain(line, fmt::format("expected {}two finite numbers, got \"{}\"). Write x,y with points as decimal marks.",
                                       may_be_heading ? "the heading x,y or " : "", printable(text, 40)));
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
