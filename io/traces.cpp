#include "io/traces.h"

#include "io/csv_row.h"
#include "io/csv_shapes.h"
#include "io/scanner.h"

#include <fmt/format.h>

namespace hdem
{
namespace
{
constexpr std::size_t most_problems = 50;
constexpr std::size_t most_points = 10'000'000;

/// What is wrong with a trace's points, or "".
std::string find_fault(const Polygon& points)
{
    if (points.size() < 2)
        return fmt::format("has {} point, a trace has at least 2). Give its two ends.", points.size());
    for (std::size_t i = 1; i < points.size(); ++i)
        if (points[i] == points[i - 1])
            return fmt::format("points {} and {} are the same). Remove one of them.", i, i + 1);
    return "";
}
}  // namespace

std::variant<Polygon, std::string> parse_wkt_line(std::string_view text)
{
    Scanner scan{trimmed(text)};
    if (starts_with_word(scan.rest, "MULTILINESTRING"))
        return "is a MULTILINESTRING). Write each of its lines on a line of its own.";
    if (!starts_with_word(scan.rest, "LINESTRING"))
        return fmt::format("expected LINESTRING, got {}). Write LINESTRING(x y, x y).", scan.here());
    scan.rest.remove_prefix(10);
    if (!scan.take('('))
        return fmt::format("expected ( after LINESTRING, got {}). Only plain LINESTRING(x y, ...) is read: no Z, no M, not EMPTY.",
                           scan.here());
    Polygon points;
    if (std::string why = scan.take_points(points, "point"); !why.empty())
        return why;
    if (!trimmed(scan.rest).empty())
        return fmt::format("{} follows the line). Write one LINESTRING a line.", Scanner{trimmed(scan.rest)}.here());
    return points;
}

TraceFile read_traces(std::istream& in, const std::string& file_name)
{
    TraceFile result;
    const auto complain = [&](int line, const std::string& why)
    {
        result.problems.push_back(
            {Problem::Severity::error, "domain.traces_file", fmt::format("{}:{}: trace: line ({}", file_name, line, why)});
    };
    const bool is_csv = has_ending(file_name, ".csv");
    CsvShapes rows(0);
    std::size_t points = 0;
    const auto keep = [&](int line, const Polygon& trace)
    {
        points += trace.size();
        if (const std::string why = find_fault(trace); !why.empty())
            complain(line, why);
        else
            result.traces.push_back(trace);
    };
    const auto add = [&](int line, std::string_view text)
    {
        if (is_csv)
        {
            ++points;
            if (const std::string why = rows.add(line, text); !why.empty())
                complain(line, why);
        }
        else if (auto parsed = parse_wkt_line(text); std::holds_alternative<std::string>(parsed))
            complain(line, std::get<std::string>(parsed));
        else
            keep(line, std::get<Polygon>(parsed));
        if (points > most_points)
            complain(line, fmt::format("more than {} points). Make the model smaller.", most_points));
        else if (result.problems.size() >= most_problems)
            complain(line, "too many problems, the rest was not read). Is this a file of traces?");
        else
            return true;
        return false;
    };
    int last = 0;
    if (const std::string why = read_lines(in, last, add); !why.empty())
        complain(last, why);
    for (const CsvShapes::Shape& shape : rows.shapes)
        keep(shape.line, shape.points);
    if (result.traces.empty() && result.problems.empty())
        complain(last, "the file has no trace). Write one LINESTRING(x y, x y) a line, or rows of name,x,y in a .csv.");
    return result;
}
}  // namespace hdem
