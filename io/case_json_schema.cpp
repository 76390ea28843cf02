#include "io/case_format.h"
#include "io/case_schema.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace hdem
{
namespace
{
using Json = nlohmann::ordered_json;

/// 5.0 as 5: whole limits read better, and integers must not be limited by floating-point numbers.
Json limit(double x)
{
    return x == std::floor(x) && std::abs(x) < 9e15 ? Json(static_cast<std::int64_t>(x)) : Json(x);
}

Json number_schema(const KeySpec& key, const char* type)
{
    Json schema = {{"type", type}};
    if (std::isfinite(key.range.low))
        schema[key.range.low_included ? "minimum" : "exclusiveMinimum"] = limit(key.range.low);
    if (std::isfinite(key.range.high))
        schema[key.range.high_included ? "maximum" : "exclusiveMaximum"] = limit(key.range.high);
    return schema;
}

Json text_schema(const KeySpec& key)
{
    if (!key.ending.empty())
        return {{"anyOf", {Json{{"enum", key.choices}}, Json{{"type", "string"}, {"pattern", "\\" + key.ending + "$"}}}}};
    return key.choices.empty() ? Json{{"type", "string"}} : Json{{"enum", key.choices}};
}

Json list_of(Json items)
{
    return {{"type", "array"}, {"items", std::move(items)}};
}

Json vector_schema(const KeySpec& key, int numbers)
{
    Json schema = list_of(number_schema(key, "number"));
    schema["minItems"] = numbers;
    schema["maxItems"] = numbers;
    return schema;
}

Json object_of_numbers(const std::vector<std::string>& names, bool are_required)
{
    Json properties = Json::object();
    for (const std::string& name : names)
        properties[name] = {{"type", "number"}};
    Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
    if (are_required)
        schema["required"] = names;
    return schema;
}

Json distribution_schema(const KeySpec& key)
{
    Json schema = object_of_numbers({"mean", "sd", "kappa", "least", "most"}, false);
    schema["properties"]["distribution"] = {{"enum", key.choices}};
    schema["required"] = {"distribution"};
    return schema;
}

Json value_schema(const KeySpec& key)
{
    switch (key.type)
    {
    case ValueType::boolean:
        return {{"type", "boolean"}};
    case ValueType::integer:
        return number_schema(key, "integer");
    case ValueType::number:
        return number_schema(key, "number");
    case ValueType::text:
        return text_schema(key);
    case ValueType::text_list:
        return list_of(text_schema(key));
    case ValueType::integer_list:
        return list_of(number_schema(key, "integer"));
    case ValueType::number_list:
        return list_of(number_schema(key, "number"));
    case ValueType::vector:
        return vector_schema(key, 2);
    case ValueType::stress:
        return vector_schema(key, 3);
    case ValueType::polygon:
    case ValueType::line:
    {
        Json schema = list_of(vector_schema(key, 2));
        schema["minItems"] = key.type == ValueType::line ? 2 : 3;
        return schema;
    }
    case ValueType::text_or_texts:
        return {{"anyOf", Json::array({text_schema(key), list_of(text_schema(key))})}};
    case ValueType::boolean_or_texts:
        return {{"anyOf", Json::array({Json{{"type", "boolean"}}, list_of(text_schema(key))})}};
    case ValueType::number_or_text:
        return {{"anyOf", Json::array({number_schema(key, "number"), text_schema(key)})}};
    case ValueType::pair_or_text:
        return {{"anyOf", Json::array({vector_schema(key, 2), text_schema(key)})}};
    case ValueType::distribution:
        return {{"anyOf", Json::array({number_schema(key, "number"), distribution_schema(key)})}};
    case ValueType::orientation:
        return object_of_numbers({"dip", "dip_direction", "section"}, true);
    }
    return {};
}

Json key_schema(const KeySpec& key)
{
    Json schema = value_schema(key);
    schema["description"] = key.effect + (key.unit.empty() ? "" : " [" + key.unit + "]");
    if (!key.default_json.empty())
        schema["default"] = Json::parse(key.default_json);
    return schema;
}

/// A table of the section's keys and no others.
Json table_schema(const SectionSpec& section)
{
    Json properties = Json::object();
    Json required = Json::array();
    for (const KeySpec& key : section.keys)
    {
        properties[key.name] = key_schema(key);
        if (key.required)
            required.push_back(key.name);
    }
    Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
    if (!required.empty())
        schema["required"] = std::move(required);
    return schema;
}

Json section_schema(const SectionSpec& section)
{
    Json schema = table_schema(section);
    if (section.kind == SectionKind::array)
        schema = list_of(std::move(schema));
    else if (section.kind == SectionKind::named)
        schema = {
            {"type", "object"}, {"additionalProperties", false}, {"patternProperties", {{"^[A-Za-z0-9_-]+$", std::move(schema)}}}};
    if (section.name == "joint")
        schema["required"] = {"default"};
    if (section.name == "stage")
        schema["minItems"] = 1;
    if (!section.about.empty())
        schema["description"] = section.about;
    return schema;
}
}  // namespace

std::string case_json_schema()
{
    const auto& sections = case_schema();
    Json schema = table_schema(sections.front());
    for (std::size_t i = 1; i < sections.size(); ++i)
        schema["properties"][sections[i].name] = section_schema(sections[i]);
    schema["required"] = {"material", "joint", "stage"};

    Json document = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "hdem case file"}};
    document.update(schema);
    return document.dump(2) + "\n";
}
}  // namespace hdem
