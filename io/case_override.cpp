#include "io/case_override.h"

#include "io/case_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace hdem
{
namespace
{
struct Step
{
    std::string name;
    std::optional<std::size_t> index;
};

/// "stage[1].max_cycles" -> {stage, 1}, {max_cycles}; nothing when the path is malformed.
std::vector<Step> split(std::string_view path)
{
    std::vector<Step> steps;
    while (true)
    {
        const auto dot = path.find('.');
        std::string_view part = path.substr(0, dot);
        Step step;
        if (const auto bracket = part.find('['); bracket != std::string_view::npos)
        {
            const std::string_view digits = part.substr(bracket + 1, part.size() - bracket - 2);
            const bool number = part.back() == ']' && !digits.empty() && digits.size() < 9 &&
                                std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
            if (!number)
                return {};
            step.index = std::stoul(std::string(digits));
            part = part.substr(0, bracket);
        }
        if (part.empty())
            return {};
        step.name = part;
        steps.push_back(step);
        if (dot == std::string_view::npos)
            return steps;
        path.remove_prefix(dot + 1);
    }
}

TomlNode& member(TomlNode& table, const std::string& key, const Place& at)
{
    for (TomlMember& existing : *table.members())
        if (existing.key == key)
            return existing.value;
    table.members()->push_back({key, at, TomlNode{TomlNode::Members{}, at}});
    return table.members()->back().value;
}

/// Entry of an array by its name, given or by default; nullptr when there is none.
TomlNode* find_entry(TomlNode::Items& entries, const std::string& array, const std::string& name)
{
    const SectionSpec* section = find_section(array);
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
        const TomlNode* given = entries[i].find("name");
        const bool same = given != nullptr ? given->text() != nullptr && *given->text() == name
                                           : section != nullptr && default_name(*section, i + 1) == name;
        if (same)
            return &entries[i];
    }
    return nullptr;
}

/// What could have been meant.
std::string entries_that_are(const TomlNode::Items& entries, const std::string& array)
{
    std::vector<std::string> names;
    for (const TomlNode& entry : entries)
        if (const TomlNode* given = entry.find("name"); given != nullptr && given->text() != nullptr && names.size() < 5)
            names.push_back(fmt::format("'{}'", printable(*given->text())));
    const std::string first = fmt::format("there are {}, from {}[0] on", entries.size(), array);
    return names.empty() ? first : fmt::format("{}, among them {}", first, fmt::join(names, ", "));
}

/// A single number for a vector that has a direction, as a force: its length along the direction that the case gives, which a
/// negative one turns back. Why there is none, or "".
std::string as_length(const TomlNode& given, TomlNode& value)
{
    const TomlNode::Items& parts = *given.items();
    const double x = parts[0].number(), y = parts[1].number(), length = std::hypot(x, y);
    if (!(length > 0.0 && std::isfinite(length)))
        return "a single number is a length along the direction that the case gives, and this vector has none";
    const double scale = value.number() / length;
    value.value = TomlNode::Items{{x * scale, value.at}, {y * scale, value.at}};
    return "";
}

/// Whether the case gives a force, an acceleration or a velocity there: other pairs of numbers are places and ranges.
bool has_direction(const SectionSpec* section, const Step& key, const TomlNode& given)
{
    const KeySpec* spec = section == nullptr || key.index ? nullptr : section->find(key.name);
    const TomlNode::Items* parts = given.items();
    return spec != nullptr && spec->type == ValueType::vector &&
           (spec->unit == "N" || spec->unit == "m/s" || spec->unit == "m/s2") && parts != nullptr && parts->size() == 2 &&
           std::ranges::all_of(*parts, &TomlNode::is_number);
}

/// Why the value could not be written, or "".
std::string write(TomlNode& document, const std::vector<Step>& steps, TomlNode value)
{
    const Place at = value.at;
    TomlNode* node = &document;
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
        const auto& [name, index] = steps[i];
        if (TomlNode::Items* entries = node->items(); entries != nullptr && i > 0)
        {
            node = find_entry(*entries, steps[i - 1].name, name);
            if (node == nullptr)
                return fmt::format("no entry of {} is called '{}'; {}", steps[i - 1].name, printable(name),
                                   entries_that_are(*entries, steps[i - 1].name));
            continue;
        }
        if (node->members() == nullptr)
            return fmt::format("'{}' is inside a key that has a value of its own", printable(name));
        const SectionSpec* section = i == 0 ? find_section(name) : nullptr;
        const bool absent_list = section != nullptr && section->kind == SectionKind::array && node->find(name) == nullptr;
        if (absent_list && steps.size() > 1)
            return fmt::format("the case has no [[{}]]", name);
        if (index && node->find(name) == nullptr)
            return fmt::format("the case gives no {}: set all of it, not one of its numbers", printable(name));
        node = &member(*node, name, at);
        if (index)
        {
            TomlNode::Items* items = node->items();
            if (items == nullptr || *index >= items->size())
                return fmt::format("{} has {} entries, counted from 0", printable(name), items == nullptr ? 0 : items->size());
            node = &(*items)[*index];
        }
    }
    if (value.is_number() && has_direction(find_section(steps.front().name), steps.back(), *node))
        if (const std::string why = as_length(*node, value); !why.empty())
            return why;
    *node = std::move(value);
    return "";
}
}  // namespace

Override parse_override(std::string_view argument)
{
    const auto equals = argument.find('=');
    const auto trimmed = [](std::string_view text)
    {
        const auto first = text.find_first_not_of(" \t");
        return first == std::string_view::npos ? std::string()
                                               : std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
    };
    if (equals == std::string_view::npos || trimmed(argument.substr(0, equals)).empty())
        throw InputError(
            std::vector<Problem>{{Problem::Severity::error, "",
                                  fmt::format("--set {}: (not of the form key=value). Write e.g. --set joint.default.cohesion=0.",
                                              printable(argument))}});
    return {trimmed(argument.substr(0, equals)), trimmed(argument.substr(equals + 1))};
}

std::vector<Problem> apply_overrides(TomlNode& document, std::span<const Override> overrides, CaseSource& source)
{
    std::vector<Problem> problems;
    for (const Override& set : overrides)
    {
        const std::string name = "--set " + printable(set.key) + "=" + printable(set.value);
        const auto complain = [&](const std::string& why, const std::string& remedy) {
            problems.push_back({Problem::Severity::error, set.key, fmt::format("{}: ({}). {}", name, why, remedy)});
        };

        const std::vector<Step> steps = split(set.key);
        auto value = parse_toml_value(set.value, source.add_source(name));
        if (steps.empty() || steps.size() > 8)
            complain("not a path of keys", "Write e.g. joint.default.cohesion, stage[1].max_cycles or joint_set.bedding.dip_deg.");
        else if (const auto* error = std::get_if<TomlError>(&value))
            complain(error->why, error->remedy);
        else if (const std::string why = write(document, steps, std::move(std::get<TomlNode>(value))); !why.empty())
            complain(why, "Compare the path with the case file.");
    }
    return problems;
}
}  // namespace hdem
