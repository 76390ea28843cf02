#include "io/distribution_key.h"

#include "core/rock/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hdem
{
namespace
{
const std::vector<std::string> table_keys = {"mean", "distribution", "sd", "kappa", "least", "most"};

const std::vector<std::pair<std::string, DistributionKind>> kinds = {{"uniform", DistributionKind::uniform},
                                                                     {"normal", DistributionKind::normal},
                                                                     {"von_mises", DistributionKind::von_mises},
                                                                     {"exponential", DistributionKind::exponential},
                                                                     {"lognormal", DistributionKind::lognormal}};

/// Keys that a distribution has besides mean, least and most.
bool takes(DistributionKind kind, const std::string& key)
{
    if (key == "sd")
        return kind == DistributionKind::uniform || kind == DistributionKind::normal || kind == DistributionKind::lognormal;
    return key != "kappa" || kind == DistributionKind::von_mises;
}

DistributionKind kind_of(const TomlNode& table)
{
    const TomlNode* name = table.find("distribution");
    for (const auto& [text, kind] : kinds)
        if (name != nullptr && name->text() != nullptr && *name->text() == text)
            return kind;
    return DistributionKind::constant;
}

std::string example_of(const KeySpec& key)
{
    return is_length(key) ? "{mean = 1.2, distribution = \"exponential\", least = 0.2}"
                          : "{mean = 25.0, distribution = \"normal\", sd = 4.0}";
}

std::vector<Complaint> check_member(const KeySpec& key, const TomlMember& member)
{
    const std::string item = "." + member.key;
    const TomlNode& value = member.value;
    if (std::ranges::find(table_keys, member.key) == table_keys.end())
    {
        const std::string near = did_you_mean(member.key, table_keys);
        return {{item, &value, near.empty() ? "unknown key" : fmt::format("unknown key; did you mean '{}'?", near),
                 fmt::format("A distribution has {}.", fmt::join(table_keys, ", "))}};
    }
    if (member.key == "distribution")
    {
        if (value.text() == nullptr)
            return {{item, &value, "expected text in quotes", "Choose from " + quoted_list(key.choices) + "."}};
        const std::string near = did_you_mean(*value.text(), key.choices);
        if (std::ranges::find(key.choices, *value.text()) == key.choices.end())
            return {{item, &value, near.empty() ? "unknown choice" : fmt::format("unknown choice; did you mean '{}'?", near),
                     "Choose from " + quoted_list(key.choices) + "."}};
        return {};
    }
    if (!value.is_number())
        return {{item, &value, "expected a number", "Write e.g. " + example_of(key) + "."}};
    const Range positive{.low = 0.0, .high = 1e8, .low_included = false}, limit{.low = 0.0, .high = 1e8};
    const bool is_limit = member.key == "least" || member.key == "most";
    const Range range = member.key == "sd" || member.key == "kappa" ? positive
                        : is_length(key) && is_limit                ? limit
                        : is_length(key)                            ? positive
                                                                    : key.range;
    if (!std::isfinite(value.number()) || !range.holds(value.number()))
        return {{item, &value, "must be " + range.describe(), "Write e.g. " + example_of(key) + "."}};
    return {};
}
}  // namespace

bool is_length(const KeySpec& key)
{
    return key.unit == "m";
}

DistributionDef read_distribution(const TomlNode& value, const KeySpec& key)
{
    DistributionDef def;
    if (value.is_number())
    {
        def.mean = value.number();
        return def;
    }
    def.kind = kind_of(value);
    const auto number = [&](const char* name) -> std::optional<double>
    {
        const TomlNode* node = value.find(name);
        return node == nullptr ? std::nullopt : std::optional<double>(node->number());
    };
    def.sd = number("sd").value_or(0.0);
    def.kappa = number("kappa").value_or(0.0);
    def.least = number("least");
    def.most = number("most");
    const bool has_limits = def.least && def.most;
    def.mean = number("mean").value_or(has_limits ? 0.5 * (*def.least + *def.most) : 0.0);
    if (key.name == "spacing" && def.is_random() && !def.least)  // else joints as near as can be make needles
        def.least = def.mean / 5.0;
    return def;
}

std::vector<Complaint> find_distribution_complaint(const KeySpec& key, const TomlNode& value)
{
    if (value.is_number())
    {
        if (std::isfinite(value.number()) && key.range.holds(value.number()))
            return {};
        KeySpec number = key;
        number.type = ValueType::number;
        return find_complaint(number, value);
    }
    if (value.members() == nullptr)
        return {{"", &value,
                 fmt::format("expected a number in {} or a distribution{}", key.unit, value.text() != nullptr ? ", got text" : ""),
                 fmt::format("Write {} = {} or {}.", key.name, key.example, example_of(key))}};
    for (const TomlMember& member : *value.members())
        if (auto found = check_member(key, member); !found.empty())
            return found;
    const DistributionKind kind = kind_of(value);
    if (kind == DistributionKind::constant)
        return {{"", &value, "has no distribution",
                 fmt::format("Add distribution, one of {}, or write a plain number.", quoted_list(key.choices))}};
    for (const TomlMember& member : *value.members())
        if (!takes(kind, member.key))
            return {{"." + member.key, &member.value, fmt::format("{} has none", *value.find("distribution")->text()),
                     "Remove it, or choose another distribution."}};
    if (kind != DistributionKind::uniform && value.find("mean") == nullptr)
        return {{"", &value, "mean is missing", "Add mean: that of the distribution before it is cut to least and most."}};
    if (kind == DistributionKind::uniform && value.find("mean") == nullptr &&
        (value.find("least") == nullptr || value.find("most") == nullptr))
        return {{"", &value, "uniform: least and most are missing, and there is no mean", "Give least and most, or mean and sd."}};
    const DistributionFault fault = find_distribution_fault(read_distribution(value, key), is_length(key));
    if (fault.why.empty())
        return {};
    const TomlNode* blamed = fault.key.empty() ? nullptr : value.find(fault.key);
    if (blamed != nullptr)
        return {{"." + fault.key, blamed, fault.why, fault.remedy}};
    return {{"", &value, fault.key.empty() ? fault.why : fault.key + " " + fault.why, fault.remedy}};
}

OrientationDef read_orientation(const TomlNode& value)
{
    return {value.find("dip")->number(), value.find("dip_direction")->number(), value.find("section")->number()};
}

std::vector<Complaint> find_orientation_complaint(const TomlNode& value)
{
    const std::string write = "Write {dip = 60.0, dip_direction = 130.0, section = 90.0}.";
    static const std::map<std::string, Range> ranges = {{"dip", {.low = 0.0, .high = 90.0}},
                                                        {"dip_direction", {.low = -360.0, .high = 360.0}},
                                                        {"section", {.low = -360.0, .high = 360.0}}};
    if (value.members() == nullptr)
        return {{"", &value, "expected dip, dip_direction and section", write}};
    for (const TomlMember& member : *value.members())
    {
        const auto found = ranges.find(member.key);
        if (found == ranges.end())
            return {{"." + member.key, &member.value, "unknown key", "An orientation has dip, dip_direction and section."}};
        if (!member.value.is_number() || !found->second.holds(member.value.number()))
            return {{"." + member.key, &member.value, "must be a number, " + found->second.describe(), write}};
    }
    for (const auto& [name, range] : ranges)
        if (value.find(name) == nullptr)
            return {{"", &value, name + " is missing", write}};
    return {};
}
}  // namespace hdem
