#include "io/pressure_table.h"

#include "io/csv_row.h"
#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace hdem
{
namespace
{
constexpr std::size_t most_rows = 100'000;
constexpr double largest = 1e12;  ///< [Pa]

constexpr std::array<CsvColumn, 3> heading = {{{"x", "m"}, {"y", "m"}, {"pressure", "Pa"}}};

bool take_row(std::span<const std::string> columns, std::array<double, 3>& row)
{
    return columns.size() == row.size() && std::ranges::equal(columns, row, read_csv_number);
}

/// "" or what is wrong with the row.
std::string find_fault(const std::array<double, 3>& row)
{
    if (std::max(std::abs(row[0]), std::abs(row[1])) > farthest_coordinate)
        return fmt::format("the point is farther than {} m from the origin). Move the model nearer to the origin.",
                           farthest_coordinate);
    if (row[2] < 0.0 || row[2] > largest)
        return fmt::format("pressure = {} Pa). Give 0 to {}: suction is not computed.", row[2], largest);
    return "";
}
}  // namespace

PressureFile read_pressures(std::istream& in, const std::string& file_name)
{
    PressureFile result;
    const auto complain = [&](int line, const std::string& why) {
        result.problems.push_back({Problem::Severity::error, "", fmt::format("{}:{}: pressures: line ({}", file_name, line, why)});
    };
    bool is_first = true;
    const auto add = [&](int line, std::string_view text)
    {
        std::array<double, 3> row{};
        const bool may_be_heading = std::exchange(is_first, false);
        const std::vector<std::string> columns = csv_columns(text);
        if (may_be_heading && columns.size() == heading.size() && is_csv_heading(columns, heading))
            return true;
        if (!take_row(columns, row))
            complain(line, fmt::format("expected {}three finite numbers, got \"{}\"). Write x,y,pressure with points as decimal "
                                       "marks.",
                                       may_be_heading ? "the heading x,y,pressure or " : "", printable(text, 40)));
        else if (const std::string why = find_fault(row); !why.empty())
            complain(line, why);
        else
            result.rows.push_back(row);
        if (result.rows.size() > most_rows)
            complain(line, fmt::format("more than {} rows). Give fewer: it is linear between them.", most_rows));
        return result.problems.empty();
    };
    int last = 0;
    if (const std::string why = read_lines(in, last, add); !why.empty())
        complain(last, why);
    auto places = result.rows;
    std::ranges::sort(places);
    const auto twice = std::ranges::adjacent_find(places,
                                                  [](const auto& a, const auto& b) { return a[0] == b[0] && a[1] == b[1]; });
    if (twice != places.end())
        complain(last, fmt::format("the point {}, {} occurs twice). Keep one of them.", (*twice)[0], (*twice)[1]));
    if (result.rows.size() < 3 && result.problems.empty())
        complain(last, fmt::format("the file has {} points). Give three at least.", result.rows.size()));
    return result;
}
}  // namespace hdem
