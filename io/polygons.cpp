#include "io/polygons.h"

#include "io/toml_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <istream>
#include <ostream>

namespace hdem
{
namespace
{
constexpr std::size_t longest_line = 1'000'000;  // bytes; some 25 000 vertices
constexpr std::size_t most_problems = 50;
constexpr std::size_t most_blocks = 20'000'000;
constexpr std::size_t largest_file = 4'000'000'000;  // bytes
constexpr double farthest = 1e8;                     // [m], the same limit as in the case file

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool starts_with_word(std::string_view text, std::string_view word)
{
    return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(),
                                                    [](char w, char t) { return w == (t >= 'a' && t <= 'z' ? t - 'a' + 'A' : t); });
}

/// Reads a text from the left; every take_ either consumes or leaves the text as it is.
struct Scanner
{
    std::string_view rest;

    bool take(char c)
    {
        rest = trimmed(rest);
        if (rest.empty() || rest.front() != c)
            return false;
        rest.remove_prefix(1);
        return true;
    }
    bool take_number(double& x)
    {
        rest = trimmed(rest);
        std::string_view digits = rest;
        if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
            digits.remove_prefix(1);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
        const bool whole_word = end == digits.data() + digits.size() ||
                                std::string_view(" \t,()").find(*end) != std::string_view::npos;
        if (error != std::errc() || !std::isfinite(x) || !whole_word)
            return false;
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        return true;
    }
    [[nodiscard]] std::string here() const { return rest.empty() ? "the end of the line" : "\"" + printable(rest, 20) + "\""; }
};

/// Reads "fixed" or a list of x, y, rotation; false when it says something else.
bool read_fixed(std::string_view text, BlockDef& block)
{
    if (text == "fixed")
    {
        block.fix_x = block.fix_y = block.fix_rotation = true;
        return true;
    }
    while (!text.empty())
    {
        const auto end = text.find_first_of(" ,\t");
        const std::string_view word = text.substr(0, end);
        if (word == "x")
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
    do
    {
        Vec2 point;
        if (!scan.take_number(point.x()) || !scan.take_number(point.y()))
            return fmt::format("expected a finite number, got {}). Vertex {} needs x and y.", scan.here(), polygon.size() + 1);
        if (std::abs(point.x()) > farthest || std::abs(point.y()) > farthest)
            return fmt::format("vertex {} is farther than {} m from the origin). Move the model nearer to the origin.",
                               polygon.size() + 1, farthest);
        polygon.push_back(point);
    } while (scan.take(','));

    if (!scan.take(')'))
        return fmt::format("expected , or ) after vertex {}, got {}). Vertices have two coordinates.", polygon.size(), scan.here());
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

PolygonFile read_polygons(std::istream& in, const std::string& file_name, std::size_t first_number)
{
    PolygonFile result;
    const auto complain = [&](int line, const std::string& why)
    {
        result.problems.push_back(
            {Problem::Severity::error, "blocks_file", fmt::format("{}:{}: block: polygon ({}", file_name, line, why)});
    };

    std::string line;
    int number = 0;
    std::size_t bytes = 0;
    for (char c = '\0'; in.get(c) || !line.empty();)
    {
        if (in && c != '\n' && line.size() <= longest_line)
        {
            line += c;
            continue;
        }
        ++number;
        bytes += line.size() + 1;
        const std::string_view text = trimmed(line);
        if (line.size() > longest_line || result.blocks.size() >= most_blocks || bytes > largest_file)
        {
            complain(number,
                     line.size() > longest_line
                         ? fmt::format("the line is longer than {} bytes). Is this a file of WKT polygons?", longest_line)
                         : fmt::format("more than {} blocks or {} bytes). Make the model smaller.", most_blocks, largest_file));
            return result;
        }
        if (!text.empty() && text.front() != '#')
        {
            BlockDef block;
            block.name = "block" + std::to_string(first_number + result.blocks.size() + 1);
            if (const std::string why = read_line(text, block); !why.empty())
                complain(number, why);
            result.blocks.push_back({std::move(block), number});
        }
        line.clear();
        if (result.problems.size() >= most_problems)
        {
            complain(number, "too many problems, the rest was not read). Is this a file of WKT polygons?");
            return result;
        }
    }
    if (result.blocks.empty() && result.problems.empty())
        complain(number, "the file has no polygon). Write one POLYGON((x y, ...)) a line.");
    return result;
}

std::string to_wkt(const Polygon& polygon)
{
    std::string text = "POLYGON((";
    for (std::size_t i = 0; i <= polygon.size() && !polygon.empty(); ++i)
    {
        const Vec2& point = polygon[i % polygon.size()];
        text += fmt::format("{}{:.17g} {:.17g}", i == 0 ? "" : ", ", point.x(), point.y());
    }
    return text + "))";
}

void write_polygons(std::ostream& out, std::span<const BlockDef> blocks)
{
    for (const BlockDef& block : blocks)
    {
        out << to_wkt(block.polygon) << "; " << block.name << "; " << block.material;
        if (block.fix_x && block.fix_y && block.fix_rotation)
            out << "; fixed";
        else if (block.fix_x || block.fix_y || block.fix_rotation)
            out << ';' << (block.fix_x ? " x" : "") << (block.fix_y ? " y" : "") << (block.fix_rotation ? " rotation" : "");
        out << '\n';
    }
}
}  // namespace hdem
