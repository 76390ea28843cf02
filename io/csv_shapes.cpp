#include "io/csv_shapes.h"

#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>

#include <cmath>

namespace hdem
{
namespace
{
std::vector<std::string_view> columns_of(std::string_view row)
{
    std::vector<std::string_view> columns;
    for (;; row.remove_prefix(row.find(',') + 1))
    {
        columns.push_back(trimmed(row.substr(0, row.find(','))));
        if (row.find(',') == std::string_view::npos)
            return columns;
    }
}

/// The whole column is a finite number.
bool read_number(std::string_view column, double& x)
{
    Scanner scan{column};
    return scan.take_number(x) && scan.rest.empty();
}
}  // namespace

std::string CsvShapes::add(int line, std::string_view row)
{
    const bool is_first = !any_row_;
    any_row_ = true;
    const std::vector<std::string_view> columns = columns_of(row);
    if (is_foreign_)
        return "";
    if (is_first && (columns[0] == "WKT" || columns[0] == "\"WKT\""))
    {
        is_foreign_ = true;
        return "is the heading of a table with shapes in WKT). Make GeoJSON of the map instead: ogr2ogr -f GeoJSON OUT.geojson "
               "MAP.";
    }
    if (columns.size() < 3)
        return fmt::format("the row has {} columns). Write name,x,y.", columns.size());
    Vec2 point;
    for (int k = 0; k < 2; ++k)
    {
        if (!read_number(columns[1 + k], point[k]))
            return is_first ? ""
                            : fmt::format("expected a finite number, got \"{}\"). Write name,x,y with points as decimal marks.",
                                          printable(columns[1 + k], 20));
        if (std::abs(point[k]) > farthest_coordinate)
            return fmt::format("the point is farther than {} m from the origin). Move the model nearer to the origin.",
                               farthest_coordinate);
    }
    if (columns[0].empty())
        return "the row has no name). Write name,x,y.";
    if (shapes.empty() || shapes.back().name != columns[0])
    {
        shapes.push_back({std::string(columns[0]), line, {}, {}});
        for (std::size_t i = 3; i < columns.size(); ++i)
            shapes.back().more.emplace_back(columns[i]);
    }
    shapes.back().points.push_back(point);
    return "";
}
}  // namespace hdem
