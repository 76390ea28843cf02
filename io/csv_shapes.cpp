#include "io/csv_shapes.h"

#include "io/csv_row.h"
#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace hdem
{
namespace
{
constexpr std::array<CsvColumn, 5> heading = {{{"", ""}, {"x", "m"}, {"y", "m"}, {"material", ""}, {"fixed", ""}}};

/// What the columns of a table may be.
std::string columns_text(std::size_t further)
{
    return further > 0 ? "name,x,y,material,fixed" : "name,x,y";
}
}  // namespace

std::string CsvShapes::add(int line, std::string_view row)
{
    const bool is_first = !std::exchange(any_row_, true);
    const std::vector<std::string> columns = csv_columns(row);
    if (is_foreign_)
        return "";
    if (is_first && columns[0] == "WKT")
    {
        is_foreign_ = true;
        return "is the heading of a table with shapes in WKT). Make GeoJSON of the map instead: ogr2ogr -f GeoJSON OUT.geojson "
               "MAP.";
    }
    if (columns.size() < 3)
        return fmt::format("the row has {} columns). Write name,x,y.", columns.size());
    if (is_first && is_csv_heading(columns, std::span(heading).first(3 + further_)))
        return "";
    if (columns.size() > 3 + further_)
        return fmt::format("has {} columns). Write at most {}.", columns.size(), columns_text(further_));
    Vec2 point;
    for (int k = 0; k < 2; ++k)
    {
        const std::string& column = columns[1 + static_cast<std::size_t>(k)];
        if (!read_csv_number(column, point[k]))
            return fmt::format("expected {}a finite number, got \"{}\"). Write {} with points as decimal marks.",
                               is_first ? "the heading " + columns_text(further_) + " or " : "", printable(column, 20),
                               columns_text(further_));
        if (std::abs(point[k]) > farthest_coordinate)
            return fmt::format("the point is farther than {} m from the origin). Move the model nearer to the origin.",
                               farthest_coordinate);
    }
    if (columns[0].empty())
        return "the row has no name). Write name,x,y.";
    const std::vector<std::string> more(columns.begin() + 3, columns.end());
    if (shapes.empty() || shapes.back().name != columns[0])
        shapes.push_back({columns[0], line, {}, more});
    for (std::size_t i = 0; i < more.size(); ++i)
        if (!more[i].empty() && (i >= shapes.back().more.size() || more[i] != shapes.back().more[i]))
            return fmt::format("\"{}\" stands in a later row of \"{}\"). Write material and fixed in the first row of a block.",
                               printable(more[i], 20), printable(columns[0], 40));
    shapes.back().points.push_back(point);
    return "";
}
}  // namespace hdem
