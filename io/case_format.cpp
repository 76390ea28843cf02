#include "io/case_format.h"

#include "io/case_format_text.h"
#include "io/case_problems.h"
#include "io/case_schema.h"
#include "io/stage_end_text.h"

#include <fmt/format.h>

namespace hdem
{
namespace
{
std::string escaped(std::string text)
{
    for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
        text.insert(i, 1, '\\');
    return text;
}

std::string code(const std::string& text)
{
    return '`' + text + '`';
}

std::string type_column(const KeySpec& key)
{
    switch (key.type)
    {
    case ValueType::boolean:
        return "true, false";
    case ValueType::integer:
        return "whole number";
    case ValueType::number:
        return "number";
    case ValueType::text:
        return "text";
    case ValueType::text_list:
        return "list of texts";
    case ValueType::integer_list:
        return "list of whole numbers";
    case ValueType::number_list:
        return "list of numbers";
    case ValueType::vector:
        return "[x, y]";
    case ValueType::stress:
        return "[xx, yy, xy]";
    case ValueType::polygon:
    case ValueType::line:
        return "list of [x, y]";
    case ValueType::text_or_texts:
        return "text or list of texts";
    case ValueType::boolean_or_texts:
        return "true, false or list";
    case ValueType::number_or_text:
        return "number or text";
    case ValueType::pair_or_text:
        return "two numbers or text";
    case ValueType::distribution:
        return "number or distribution";
    case ValueType::orientation:
        return "{dip, dip_direction, section}";
    }
    return "";
}

std::string range_column(const KeySpec& key)
{
    constexpr double shown = 2e4;  // farther limits only keep arithmetic finite
    std::string text = key.range.describe(shown);
    for (const std::string& choice : key.choices)
        text += (text.empty() ? "" : ", ") + code('"' + choice + '"');
    if (!key.ending.empty())
        text += ", a file " + code("\"*" + key.ending + "\"");
    return text;
}

std::string default_column(const KeySpec& key)
{
    if (key.required)
        return "**required**";
    if (!key.default_json.empty())
        return code(key.default_json);
    return key.default_note.empty() ? "none" : key.default_note;
}

std::string section_page(const SectionSpec& section)
{
    const std::string heading = section.kind == SectionKind::top ? "Top of the file" : section.heading();
    std::string page = fmt::format("### {}\n\n{}{}", heading, section.about, section.about.empty() ? "" : "\n\n");
    page += "| Key | Type | Unit | Default | Range | Effect |\n|---|---|---|---|---|---|\n";
    for (const KeySpec& key : section.keys)
        page += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(key.name), type_column(key),
                            key.unit.empty() ? "-" : key.unit, escaped(default_column(key)), range_column(key),
                            escaped(key.effect));
    return page + "\n";
}
}  // namespace

std::string_view case_example()
{
    return format_text::example;
}

std::string case_format_markdown()
{
    std::string page = std::string(format_text::introduction) + std::string(format_text::example) +
                       "```\n\n## All keys\n\nEquations are those of the publication that README.md cites.\n\n";
    for (const SectionSpec& section : case_schema())
        page += section_page(section);
    return page + std::string(stage_end_page()) + std::string(format_text::semantics);
}
}  // namespace hdem
