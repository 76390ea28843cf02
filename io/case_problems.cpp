#include "io/case_problems.h"

#include "core/model/near_name.h"
#include "io/distribution_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hdem
{
namespace
{
/// More lines than this help nobody; the last one says how many there are.
constexpr std::size_t most_errors = 200;

std::string kind_of(const TomlNode& node)
{
    if (node.boolean() != nullptr)
        return "true or false";
    if (node.is_number())
        return "a number";
    if (node.text() != nullptr)
        return "text";
    if (node.items() != nullptr)
        return "a list";
    return node.members() != nullptr ? "a table" : "a date";
}

std::string give(const KeySpec& key)
{
    std::string text = "Give " + describe_type(key);
    if (const auto range = key.range.describe();
        !range.empty() && key.type != ValueType::number_or_text && key.type != ValueType::pair_or_text)
        text += ", " + range;
    return text + (key.example.empty() ? "." : fmt::format(", e.g. {} = {}.", key.name, key.example));
}

using Complaints = std::vector<Complaint>;

/// @param expected of an item of a list, when it is not the type of the key
Complaints wrong_type(const KeySpec& key, const TomlNode& node, const std::string& item = "", std::string expected = "")
{
    if (item.empty())
        expected = describe_type(key);
    if (key.unit.empty() || node.text() == nullptr || key.type == ValueType::text)
        return {{item, &node, fmt::format("expected {}, got {}", expected, kind_of(node)), give(key)}};
    return {{item, &node, fmt::format("expected {}, got text", expected),
             "Values carry no unit and no quotes." +
                 (key.example.empty() ? "" : fmt::format(" Write {} = {}.", key.name, key.example))}};
}

Complaints check_number(const KeySpec& key, const TomlNode& node, const std::string& item = "")
{
    const bool whole = key.type == ValueType::integer || key.type == ValueType::integer_list;
    if (!node.is_number())
        return wrong_type(key, node, item, whole ? "a whole number" : key.unit.empty() ? "a number" : "a number in " + key.unit);
    const double x = node.number();
    if (!std::isfinite(x))
        return {{item, &node, "must be finite", give(key)}};
    if (whole && node.integer() == nullptr && (x != std::floor(x) || std::abs(x) > 9e15))
        return {{item, &node, "must be a whole number", give(key)}};
    if (!key.range.holds(x))
        return {{item, &node, "must be " + key.range.describe(), give(key)}};
    return {};
}

Complaints check_text(const KeySpec& key, const TomlNode& node, const std::string& item = "")
{
    if (node.text() == nullptr)
        return wrong_type(key, node, item, "text in quotes");
    const std::string& text = *node.text();
    if (key.choices.empty() || std::find(key.choices.begin(), key.choices.end(), text) != key.choices.end() ||
        (!key.ending.empty() && text.ends_with(key.ending)))
        return {};
    const std::string near = did_you_mean(text, key.choices);
    return {{item, &node, near.empty() ? "unknown choice" : fmt::format("unknown choice; did you mean '{}'?", near),
             "Choose from " + quoted_list(key.choices) +
                 (key.ending.empty() ? "." : fmt::format(", or name a file with the ending {}.", key.ending))}};
}

Complaints check_vector(const KeySpec& key, const TomlNode& node, std::size_t numbers, const std::string& item = "")
{
    if (node.items() == nullptr)
        return wrong_type(key, node, item, numbers == 2 ? "[x, y]" : "[xx, yy, xy]");
    if (node.items()->size() != numbers)
        return {{item, &node,
                 fmt::format("has {} numbers, {}", node.items()->size(),
                             numbers == 2 ? "a point or vector has two" : "a stress has three"),
                 numbers == 2 ? "Write [x, y]." : "Write [xx, yy, xy]."}};
    for (std::size_t i = 0; i < numbers; ++i)
        if (auto found = check_number(key, (*node.items())[i], fmt::format("{}[{}]", item, i)); !found.empty())
            return found;
    return {};
}

template <class CheckItem>
Complaints check_items(const KeySpec& key, const TomlNode& node, CheckItem check_item)
{
    if (node.items() == nullptr)
        return wrong_type(key, node);
    for (std::size_t i = 0; i < node.items()->size(); ++i)
        if (auto found = check_item(key, (*node.items())[i], fmt::format("[{}]", i)); !found.empty())
            return found;
    return {};
}

Complaints check_points(const KeySpec& key, const TomlNode& node, std::size_t least, const char* what)
{
    auto found = check_items(key, node,
                             [](const KeySpec& k, const TomlNode& point, const std::string& item)
                             { return check_vector(k, point, 2, item); });
    if (found.empty() && node.items()->size() < least)
        found.push_back({"", &node, fmt::format("has {} {} has at least {}", node.items()->size(), what, least),
                         fmt::format("Write [[x, y], [x, y], {}...].", least > 2 ? "[x, y], " : "")});
    return found;
}
}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names)
{
    return printable(nearest_name(word, names));
}

void CaseProblems::add(const std::string& key, const std::string& object, const std::string& said, const std::string& why,
                       const std::string& remedy)
{
    if (!keys_.insert(key).second || ++errors_ > most_errors)
        return;
    problems_.push_back({Problem::Severity::error, key, fmt::format("{}: {} ({}). {}", object, said, why, remedy)});
}

void CaseProblems::warn(const std::string& key, const std::string& object, const std::string& said, const std::string& why,
                        const std::string& remedy)
{
    if (!has(key))
        problems_.push_back({Problem::Severity::warning, key, fmt::format("{}: {} ({}). {}", object, said, why, remedy)});
}

bool CaseProblems::has_in_entries(const std::string& section, const std::string& key) const
{
    const std::string start = section + "[", end = "]." + key;
    for (auto found = keys_.lower_bound(start); found != keys_.end() && found->starts_with(start); ++found)
        if (found->ends_with(end) && found->find(']') == found->size() - end.size())
            return true;
    return false;
}

std::vector<Problem> CaseProblems::errors() const
{
    std::vector<Problem> result;
    for (const Problem& problem : problems_)
        if (problem.severity == Problem::Severity::error)
            result.push_back(problem);
    if (errors_ > most_errors)
        result.push_back(
            {Problem::Severity::error, "",
             fmt::format("case: {} more errors (not shown). Correct the first ones and try again.", errors_ - most_errors)});
    return result;
}

std::vector<Problem> CaseProblems::warnings() const
{
    std::vector<Problem> result;
    for (const Problem& problem : problems_)
        if (problem.severity == Problem::Severity::warning)
            result.push_back(problem);
    return result;
}

std::vector<Complaint> find_complaint(const KeySpec& key, const TomlNode& value)
{
    const auto check_item_text = [](const KeySpec& k, const TomlNode& n, const std::string& i) { return check_text(k, n, i); };
    switch (key.type)
    {
    case ValueType::boolean:
        return value.boolean() != nullptr ? Complaints{} : wrong_type(key, value);
    case ValueType::integer:
    case ValueType::number:
        return check_number(key, value);
    case ValueType::text:
        return check_text(key, value);
    case ValueType::text_list:
        return check_items(key, value, check_item_text);
    case ValueType::integer_list:
    case ValueType::number_list:
        return check_items(key, value, check_number);
    case ValueType::vector:
        return check_vector(key, value, 2);
    case ValueType::stress:
        return check_vector(key, value, 3);
    case ValueType::polygon:
        return check_points(key, value, 3, "vertices, a polygon");
    case ValueType::line:
        return check_points(key, value, 2, "points, a line");
    case ValueType::text_or_texts:
        return value.text() != nullptr ? check_text(key, value) : check_items(key, value, check_item_text);
    case ValueType::boolean_or_texts:
        return value.boolean() != nullptr ? Complaints{} : check_items(key, value, check_item_text);
    case ValueType::number_or_text:
        return value.text() != nullptr ? check_text(key, value) : check_number(key, value);
    case ValueType::pair_or_text:
        return value.text() != nullptr ? check_text(key, value) : check_vector(key, value, 2);
    case ValueType::distribution:
        return find_distribution_complaint(key, value);
    case ValueType::orientation:
        return find_orientation_complaint(value);
    }
    return {};
}

std::string quoted_list(const std::vector<std::string>& names)
{
    std::vector<std::string> shown;
    for (const std::string& name : names)
        shown.push_back(printable(name));
    return fmt::format("\"{}\"", fmt::join(shown, "\", \""));
}

std::string describe_type(const KeySpec& key)
{
    const std::string in = key.unit.empty() ? "" : " in " + key.unit;
    const std::string choices = key.choices.empty() ? "" : quoted_list(key.choices);
    switch (key.type)
    {
    case ValueType::boolean:
        return "true or false";
    case ValueType::integer:
        return "a whole number";
    case ValueType::number:
        return "a number" + in;
    case ValueType::text:
        return choices.empty() ? "text in quotes" : key.choices.size() == 1 ? choices : "one of " + choices;
    case ValueType::text_list:
        return choices.empty() ? "a list of texts" : "a list from " + choices;
    case ValueType::integer_list:
        return "a list of whole numbers";
    case ValueType::number_list:
        return "a list of numbers" + in;
    case ValueType::vector:
        return "[x, y]" + in;
    case ValueType::stress:
        return "[xx, yy, xy]" + in;
    case ValueType::polygon:
    case ValueType::line:
        return "a list of points [x, y]" + in;
    case ValueType::text_or_texts:
        return "text in quotes or a list of texts";
    case ValueType::boolean_or_texts:
        return "true, false or a list from " + choices;
    case ValueType::number_or_text:
        return "a number" + in + " or " + choices;
    case ValueType::pair_or_text:
        return "two numbers" + in + " or " + choices;
    case ValueType::distribution:
        return "a number" + in + " or a distribution";
    case ValueType::orientation:
        return "{dip, dip_direction, section}" + in;
    }
    return "";
}
}  // namespace hdem
