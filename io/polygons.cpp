#include "io/polygons.h"

#include "io/csv_row.h"
#include "io/csv_shapes.h"
#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>

#include <ostream>

namespace hdem
{
namespace
{
constexpr std::size_t most_problems = 50;
constexpr std::size_t most_blocks = 20'000'000;

/// Reads "fixed" or a list of x, y, rotation; false when it says something else.
/// One line of the file; returns what is wrong with it, or "".
std::string read_line(std::string_view line, BlockDef& block)
{
    std::vector<std::string_view> fields;
    for (std::string_view rest = line;; rest.remove_prefix(rest.find(';') + 1))
    {
        fields.push_back(trimmed(rest.substr(0, rest.find(';'))));
        if (rest.find(';') == std::string_view::npos)
            break;
    }
    auto parsed = parse_wkt(fields[0]);
    if (const auto* why = std::get_if<std::string>(&parsed))
        return *why;
    block.polygon = std::move(std::get<Polygon>(parsed));
    if (fields.size() > 4)
        return fmt::format("has {} fields behind the polygon). Write at most name; material; fixed.", fields.size() - 1);
    if (fields.size() > 1 && !fields[1].empty())
        block.name = fields[1];
    if (fields.size() > 2 && !fields[2].empty())
        block.material = fields[2];
    if (fields.size() > 3 && !read_fixed(fields[3], block))
        return fmt::format("\"{}\" does not say what is fixed). Write fixed, or a list of x, y, rotation.", printable(fields[3]));
    return "";
}

/// A block from the rows of a table; returns what is wrong with it, or "".
std::string read_shape(const CsvShapes::Shape& shape, BlockDef& block)
{
    block.name = shape.name;
    block.polygon = shape.points;
    if (block.polygon.size() > 1 && block.polygon.front() == block.polygon.back())
        block.polygon.pop_back();
    if (!shape.more.empty() && !shape.more[0].empty())
        block.material = shape.more[0];
    if (shape.more.size() > 1 && !read_fixed(shape.more[1], block))
        return fmt::format("\"{}\" does not say what is fixed). Write fixed, or a list of x, y, rotation with spaces.",
                           printable(shape.more[1]));
    if (block.polygon.size() < 3)
        return fmt::format(
            "\"{}\" has {} rows, a polygon has at least 3 vertices). Give each vertex a row, rows of a block after each other.",
            printable(shape.name), block.polygon.size());
    return "";
}
}  // namespace

std::variant<Polygon, std::string> parse_wkt(std::string_view text)
{
    Scanner scan{trimmed(text)};
    if (starts_with_word(scan.rest, "MULTIPOLYGON"))
        return "is a MULTIPOLYGON). Write each of its polygons on a line of its own.";
    if (!starts_with_word(scan.rest, "POLYGON"))
        return fmt::format("expected POLYGON, got {}). Write POLYGON((x y, x y, x y, x y)).", scan.here());
    scan.rest.remove_prefix(7);
    if (!scan.take('('))
        return fmt::format("expected ( after POLYGON, got {}). Only plain POLYGON((x y, ...)) is read: no Z, no M, not EMPTY.",
                           scan.here());
    if (!scan.take('('))
        return fmt::format("expected (( after POLYGON, got {}). Write POLYGON((x y, x y, x y, x y)).", scan.here());

    Polygon polygon;
    if (std::string why = scan.take_points(polygon, "vertex"); !why.empty())
        return why;
    if (scan.take(','))
        return "has a hole). Blocks have no holes: cut the ring into two polygons.";
    if (!scan.take(')'))
        return fmt::format("expected )) at the end, got {}). Close both brackets.", scan.here());
    if (!trimmed(scan.rest).empty())
        return fmt::format("{} follows the polygon). Put name and material behind a semicolon.",
                           Scanner{trimmed(scan.rest)}.here());
    if (polygon.size() < 4)
        return fmt::format("has {} points, a closed ring has at least 4). Repeat the first point at the end.", polygon.size());
    if (polygon.front() != polygon.back())
        return "the ring is not closed). Repeat the first point at the end.";
    polygon.pop_back();
    return polygon;
}

bool read_fixed(std::string_view text, BlockDef& block)
{
    while (!text.empty())
    {
        const auto end = text.find_first_of(" ,\t");
        const std::string_view word = text.substr(0, end);
        if (word == "fixed")
            block.fix_x = block.fix_y = block.fix_rotation = true;
        else if (word == "x")
            block.fix_x = true;
        else if (word == "y")
            block.fix_y = true;
        else if (word == "rotation")
            block.fix_rotation = true;
        else if (!word.empty())
            return false;
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return true;
}

PolygonFile read_polygons(std::istream& in, const std::string& file_name, std::size_t first_number)
{
    PolygonFile result;
    const auto complain = [&](int line, const std::string& why)
    {
        result.problems.push_back(
            {Problem::Severity::error, "blocks_file", fmt::format("{}:{}: block: polygon ({}", file_name, line, why)});
    };
    const bool is_csv = has_ending(file_name, ".csv");
    CsvShapes rows(2);
    const auto add = [&](int line, std::string_view text)
    {
        if (result.blocks.size() >= most_blocks)
            complain(line, fmt::format("more than {} blocks). Make the model smaller.", most_blocks));
        else if (result.problems.size() >= most_problems)
            complain(line, "too many problems, the rest was not read). Is this a file of polygons?");
        else
        {
            if (is_csv)
            {
                if (const std::string why = rows.add(line, text); !why.empty())
                    complain(line, why);
                return true;
            }
            BlockDef block;
            block.name = "block" + std::to_string(first_number + result.blocks.size() + 1);
            if (const std::string why = read_line(text, block); !why.empty())
                complain(line, why);
            result.blocks.push_back({std::move(block), line});
            return true;
        }
        return false;
    };
    int last = 0;
    if (const std::string why = read_lines(in, last, add); !why.empty())
        complain(last, why);
    for (const CsvShapes::Shape& shape : rows.shapes)
    {
        result.blocks.push_back({{}, shape.line});
        if (const std::string why = read_shape(shape, result.blocks.back().block); !why.empty())
            complain(shape.line, why);
    }
    if (result.blocks.empty() && result.problems.empty())
        complain(last, "the file has no polygon). Write one POLYGON((x y, ...)) a line, or rows of name,x,y in a .csv.");
    return result;
}

std::string to_wkt(const Polygon& polygon, std::span<const Polygon> holes)
{
    const auto ring_text = [](const Polygon& ring)
    {
        std::string text = "(";
        for (std::size_t i = 0; i <= ring.size() && !ring.empty(); ++i)
        {
            const Vec2& point = ring[i % ring.size()];
            text += fmt::format("{}{:.17g} {:.17g}", i == 0 ? "" : ", ", point.x(), point.y());
        }
        return text + ")";
    };
    std::string text = "POLYGON(" + ring_text(polygon);
    for (const Polygon& hole : holes)
        text += ", " + ring_text(hole);
    return text + ")";
}

void write_polygon(std::ostream& out, const BlockDef& block, std::span<const Polygon> holes)
{
    out << to_wkt(block.polygon, holes) << "; " << block.name << "; " << block.material;
    if (block.fix_x && block.fix_y && block.fix_rotation)
        out << "; fixed";
    else if (block.fix_x || block.fix_y || block.fix_rotation)
        out << ';' << (block.fix_x ? " x" : "") << (block.fix_y ? " y" : "") << (block.fix_rotation ? " rotation" : "");
    out << '\n';
}

void write_polygons(std::ostream& out, std::span<const BlockDef> blocks)
{
    for (const BlockDef& block : blocks)
        write_polygon(out, block);
}
}  // namespace hdem
