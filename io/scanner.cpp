#include "io/scanner.h"

#include "io/toml_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>

namespace hdem
{
namespace
{
constexpr std::size_t longest_line = 1'000'000;      // bytes; some 25 000 vertices
constexpr std::size_t largest_file = 4'000'000'000;  // bytes
constexpr std::string_view mark = "\xef\xbb\xbf";    // of UTF-8, with which some editors and spreadsheets begin a file

/// Lead and continuation bytes belong together; what they say is not looked at.
bool is_utf8(std::string_view text)
{
    std::size_t more = 0;
    for (const char c : text)
    {
        const auto byte = static_cast<unsigned char>(c);
        const bool continues = (byte & 0xc0U) == 0x80U;
        if (continues != (more > 0) || byte > 0xf4)
            return false;
        more = continues ? more - 1 : byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : byte >= 0xc0 ? 1 : 0;
    }
    return more == 0;
}
}  // namespace

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

bool Scanner::take(char c)
{
    rest = trimmed(rest);
    if (rest.empty() || rest.front() != c)
        return false;
    rest.remove_prefix(1);
    return true;
}

bool Scanner::take_number(double& x)
{
    rest = trimmed(rest);
    std::string_view digits = rest;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
        digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    const bool whole_word = end == digits.data() + digits.size() || std::string_view(" \t,()").find(*end) != std::string_view::npos;
    if (error != std::errc() || !std::isfinite(x) || !whole_word)
        return false;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return true;
}

std::string Scanner::take_points(Polygon& points, std::string_view kind)
{
    do
    {
        Vec2 point;
        if (!take_number(point.x()) || !take_number(point.y()))
            return fmt::format("expected a finite number, got {}). A {} has x and y, this is number {}.", here(), kind,
                               points.size() + 1);
        if (std::abs(point.x()) > farthest_coordinate || std::abs(point.y()) > farthest_coordinate)
            return fmt::format("{} {} is farther than {} m from the origin). Move the model nearer to the origin.", kind,
                               points.size() + 1, farthest_coordinate);
        points.push_back(point);
    } while (take(','));
    if (!take(')'))
        return fmt::format("expected , or ) after {} {}, got {}). A {} has two coordinates.", kind, points.size(), here(), kind);
    return "";
}

std::string Scanner::here() const
{
    return rest.empty() ? "the end of the line" : "\"" + printable(rest, 20) + "\"";
}

std::string read_lines(std::istream& in, int& last, const std::function<bool(int, std::string_view)>& use)
{
    std::string line;
    std::size_t bytes = 0;
    last = 0;
    for (char c = '\0'; in.get(c) || !line.empty();)
    {
        if (in && c != '\n' && line.size() <= longest_line)
        {
            line += c;
            continue;
        }
        ++last;
        bytes += line.size() + 1;
        if (line.size() > longest_line)
            return fmt::format("the line is longer than {} bytes). Is this a text file with a shape a line?", longest_line);
        if (bytes > largest_file)
            return fmt::format("more than {} bytes). Make the model smaller.", largest_file);
        if (!is_utf8(line))
            return "the line is not UTF-8 text). Save the file as UTF-8.";
        const std::string_view text = trimmed(last == 1 && line.starts_with(mark) ? std::string_view(line).substr(mark.size())
                                                                                  : line);
        if (!text.empty() && text.front() != '#' && !use(last, text))
            return "";
        line.clear();
    }
    return "";
}
}  // namespace hdem
