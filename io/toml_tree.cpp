#include "io/toml_tree.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>

namespace hdem
{
namespace
{
/// Dotted keys (a.b.c) build one table per dot, and tables are destroyed recursively: two million dots would exhaust
/// the stack. The TOML library limits nested values but not dots. No key of a case file has more than two.
constexpr int most_dots_in_a_key = 8;

/// Where text inside quotes that starts at `begin` ends (one past the closing quotes), or the end of the text.
std::size_t end_of_string(std::string_view text, std::size_t begin)
{
    const char quote = text[begin];
    const bool multiline = text.substr(begin, 3) == std::string(3, quote);
    std::size_t i = begin + (multiline ? 3 : 1);
    for (; i < text.size(); ++i)
    {
        if (quote == '"' && text[i] == '\\')
            ++i;
        else if (!multiline && (text[i] == quote || text[i] == '\n'))
            return i + 1;
        else if (multiline && text.substr(i, 3) == std::string(3, quote))
            return i + 3;
    }
    return text.size();
}

/// A key of more than most_dots_in_a_key dots, if the text has one. Strings and comments are skipped by the rules of
/// TOML; where the text breaks them the library stops reading, so what follows need not be right.
std::optional<Place> find_deep_key(std::string_view text)
{
    int dots = 0;
    Place at{.line = 1, .column = 1};
    std::size_t line_begin = 0;
    for (std::size_t i = 0; i < text.size();)
    {
        const char c = text[i];
        if (c == '"' || c == '\'')
        {
            const std::size_t end = end_of_string(text, i);
            const auto string = text.substr(i, end - i);
            at.line += static_cast<int>(std::count(string.begin(), string.end(), '\n'));
            i = end;
            continue;
        }
        if (c == '#')
        {
            i = std::min(text.find('\n', i), text.size());
            continue;
        }
        if (c == '\n')
        {
            ++at.line;
            line_begin = i + 1;
        }
        if (c == '.')
            ++dots;
        else if (std::string_view("\n=[]{},").find(c) != std::string_view::npos)
            dots = 0;
        if (dots > most_dots_in_a_key)
        {
            at.column = static_cast<int>(i - std::min(i, line_begin)) + 1;
            return at;
        }
        ++i;
    }
    return std::nullopt;
}

Place place(const toml::source_region& region)
{
    return {.line = static_cast<int>(region.begin.line), .column = static_cast<int>(region.begin.column)};
}

TomlNode convert(const toml::node& node)
{
    TomlNode result{.value = TomlNode::Date{}, .at = place(node.source())};
    if (const auto* boolean = node.as_boolean())
        result.value = boolean->get();
    else if (const auto* integer = node.as_integer())
        result.value = integer->get();
    else if (const auto* floating = node.as_floating_point())
        result.value = floating->get();
    else if (const auto* text = node.as_string())
        result.value = text->get();
    else if (const auto* array = node.as_array())
    {
        TomlNode::Items items;
        items.reserve(array->size());
        for (const auto& item : *array)
            items.push_back(convert(item));
        result.value = std::move(items);
    }
    else if (const auto* table = node.as_table())
    {
        TomlNode::Members members;
        members.reserve(table->size());
        for (const auto& [key, value] : *table)
            members.push_back({std::string(key.str()), place(key.source()), convert(value)});
        std::sort(members.begin(), members.end(),
                  [](const TomlMember& a, const TomlMember& b)
                  { return std::pair(a.key_at.line, a.key_at.column) < std::pair(b.key_at.line, b.key_at.column); });
        result.value = std::move(members);
    }
    return result;
}

void move_to(TomlNode& node, const Place& at)
{
    node.at = at;
    if (auto* items = node.items())
        for (TomlNode& item : *items)
            move_to(item, at);
    if (auto* members = node.members())
        for (TomlMember& member : *members)
        {
            member.key_at = at;
            move_to(member.value, at);
        }
}
}  // namespace

double TomlNode::number() const
{
    return integer() != nullptr ? static_cast<double>(*integer()) : *floating();
}

const TomlNode* TomlNode::find(std::string_view key) const
{
    if (const Members* all = members())
        for (const TomlMember& member : *all)
            if (member.key == key)
                return &member.value;
    return nullptr;
}

std::variant<TomlNode, TomlError> parse_toml(std::string_view text)
{
    if (const auto deep = find_deep_key(text))
        return TomlError{*deep, fmt::format("a key has more than {} dots", most_dots_in_a_key),
                         "Keys of a case file have at most two, e.g. joint.default.cohesion."};
    try
    {
        return convert(toml::parse(text));
    }
    catch (const toml::parse_error& error)
    {
        return TomlError{place(error.source()), "not valid TOML: " + printable(error.description(), 200),
                         "Correct this line; https://toml.io shows the syntax."};
    }
}

std::variant<TomlNode, TomlError> parse_toml_value(std::string_view text, int source)
{
    const Place at{.source = source};
    TomlNode value{.value = std::string(text), .at = at};
    if (text.find_first_of("\r\n") != std::string_view::npos)
        return TomlError{at, "the value has a line break", "Give one value on one line."};

    auto parsed = parse_toml("value = " + std::string(text));
    if (auto* document = std::get_if<TomlNode>(&parsed); document != nullptr && document->members()->size() == 1)
        value = std::move(document->members()->front().value);
    else if (text.find_first_of("\"'[]{}=,") != std::string_view::npos)
        return TomlError{at, "the value is neither TOML nor a bare word", "Write a number, a word, \"text\" or [list]."};
    else if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }))
        return TomlError{at, "the value has characters outside ASCII", "Put it into quotes: '\"text\"'."};
    move_to(value, at);
    return value;
}

std::string printable(std::string_view text, std::size_t longest)
{
    std::string result;
    for (const char c : text)
    {
        if (result.size() >= longest && (static_cast<unsigned char>(c) & 0xc0U) != 0x80U)  // never inside a UTF-8 character
            return result + "...";
        const auto byte = static_cast<unsigned char>(c);
        result += byte < 0x20 || byte == 0x7f ? '?' : c;
    }
    return result;
}

std::string brief(const TomlNode& node)
{
    if (const bool* boolean = node.boolean())
        return *boolean ? "true" : "false";
    if (const auto* integer = node.integer())
        return fmt::format("{}", *integer);
    if (const auto* floating = node.floating())
        return fmt::format("{}", *floating);
    if (const auto* text = node.text())
        return '"' + printable(*text) + '"';
    if (node.members() != nullptr)
        return "{...}";
    if (const auto* items = node.items())
    {
        std::string list;
        for (std::size_t i = 0; i < std::min<std::size_t>(items->size(), 3); ++i)
            list += (i == 0 ? "" : ", ") + ((*items)[i].items() != nullptr ? std::string("[...]") : brief((*items)[i]));
        return '[' + list + (items->size() > 3 ? ", ...]" : "]");
    }
    return "a date";
}
}  // namespace hdem
