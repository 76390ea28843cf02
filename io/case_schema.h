#pragma once
/// The one table of every key a case file may have. It drives reading, defaults, range checks, io/case_format.md and the
/// JSON Schema: to add a key, add the field to its struct in core/model/*_def.h and one entry to one of the case_schema_*.cpp.

#include "core/model/case_def.h"
#include "io/toml_tree.h"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace hdem
{
/// Version of the case file's format, the value of the key `schema`.
inline constexpr int case_schema_version = 1;

enum class ValueType
{
    boolean,
    integer,
    number,
    text,
    text_list,
    integer_list,
    number_list,
    vector,            ///< [x, y]
    stress,            ///< [xx, yy, xy]
    polygon,           ///< [[x, y], [x, y], [x, y], ...]
    line,              ///< [[x, y], [x, y], ...], not closed
    text_or_texts,     ///< a text or a list of texts
    boolean_or_texts,  ///< true, false or a list of choices
    number_or_text,    ///< a number or one of the choices
    pair_or_text,      ///< two numbers or one of the choices
    distribution,      ///< a number or a table of a distribution: io/distribution_key.h
    orientation        ///< a table {dip, dip_direction, section}
};

/// Interval that a number, or each number of a list, lies in.
struct Range
{
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_included = true;
    bool high_included = true;

    [[nodiscard]] bool holds(double x) const
    {
        return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high);
    }
    /// "> 0", "0 to 1", ">= 0 and < 90"; empty when everything is allowed. Limits beyond `shown` are left out.
    [[nodiscard]] std::string describe(double shown = std::numeric_limits<double>::max()) const;
};

struct KeySpec
{
    std::string name;
    ValueType type = ValueType::number;
    std::string unit;     ///< "" = none
    std::string effect;   ///< one sentence or two for users
    std::string example;  ///< a value as written in the file
    Range range;
    std::vector<std::string> choices;  ///< of a text or of the texts of a list; empty: any text
    std::string ending;                ///< a text with this ending is taken besides the choices; "" = none
    bool required = false;
    std::string default_json;  ///< value of a new struct's field as JSON (which is TOML as well); "" = not given
    std::string default_note;  ///< what happens when the key is not given and has no value
    /// Writes a checked value into the struct the section opened.
    void (*assign)(void* object, const TomlNode& value, const KeySpec& key) = nullptr;
};

enum class SectionKind
{
    top,    ///< keys before the first header
    table,  ///< [name]
    named,  ///< [name.NAME], any number
    array   ///< [[name]], any number
};

struct SectionSpec
{
    std::string name;
    SectionKind kind = SectionKind::table;
    std::string label;  ///< what one entry is called in messages: "joint set"
    std::string about;  ///< for users, in front of the table of keys
    std::vector<KeySpec> keys;
    /// Struct the keys are written into: the case's own, or a new entry of its list with this name.
    void* (*open)(CaseDef& def, const std::string& name) = nullptr;

    [[nodiscard]] const KeySpec* find(std::string_view key) const;
    /// "[contact]", "[joint.NAME]", "[[stage]]" or "the top of the file".
    [[nodiscard]] std::string heading() const;
};

/// All sections in the order of the documentation; the first is the top of the file.
const std::vector<SectionSpec>& case_schema();
const SectionSpec* find_section(std::string_view name);

/// Name an entry of a list gets when the user gives none: "set2", "block1", ...; `number` counts from 1.
std::string default_name(const SectionSpec& section, std::size_t number);

/// Quantities a [[history]] can sample, of one block or between two.
const std::vector<std::string>& block_quantities();
const std::vector<std::string>& contact_quantities();
const std::vector<std::string>& bolt_quantities();
const std::vector<std::string>& liner_quantities();
const std::vector<std::string>& point_quantities();
/// Quantities of the kind of history that this one is.
const std::vector<std::string>& fitting_quantities(const HistoryDef& history);
}  // namespace hdem
