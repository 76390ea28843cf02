#pragma once
/// From a field of a struct of core/model/*_def.h to an entry of the schema table: type, default and assignment follow from the field itself.
/// For the files io/case_schema*.cpp only.

#include "io/case_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <type_traits>

namespace hdem::fields
{
// Upper limits are far above anything physical; they keep products of legal values finite.
inline constexpr Range positive{.low = 0, .high = 1e18, .low_included = false};
inline constexpr Range non_negative{.low = 0, .high = 1e18};
inline constexpr Range any_size{.low = -1e18, .high = 1e18};
inline constexpr Range length{.low = 0, .high = 1e8, .low_included = false};
inline constexpr Range coordinate{.low = -1e8, .high = 1e8};
inline constexpr Range speed{.low = -1e6, .high = 1e6};
inline constexpr Range share{.low = 0, .high = 1};
inline constexpr Range count{.low = 1, .high = 1e15};
inline constexpr Range count_or_none{.low = 0, .high = 1e15};

template <class Pointer>
struct MemberTraits;
template <class Owner_, class Type_>
struct MemberTraits<Type_ Owner_::*>
{
    using Owner = Owner_;
    using Type = Type_;
};

template <class T>
struct IsOptional : std::false_type
{
};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type
{
};

template <class T>
constexpr ValueType type_of()
{
    if constexpr (IsOptional<T>::value)
        return type_of<typename T::value_type>();
    else if constexpr (std::is_same_v<T, bool>)
        return ValueType::boolean;
    else if constexpr (std::is_enum_v<T> || std::is_same_v<T, std::string>)
        return ValueType::text;
    else if constexpr (std::is_integral_v<T>)
        return ValueType::integer;
    else if constexpr (std::is_same_v<T, Vec2>)
        return ValueType::vector;
    else if constexpr (std::is_same_v<T, StressDef>)
        return ValueType::stress;
    else if constexpr (std::is_same_v<T, Polygon>)
        return ValueType::polygon;
    else if constexpr (std::is_same_v<T, FactorTable>)
        return ValueType::line;
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
        return ValueType::text_list;
    else if constexpr (std::is_same_v<T, std::vector<int>>)
        return ValueType::integer_list;
    else if constexpr (std::is_same_v<T, std::vector<double>>)
        return ValueType::number_list;
    else
    {
        static_assert(std::is_same_v<T, double>);
        return ValueType::number;
    }
}

/// A whole number, written as 5000 or 5e3.
inline std::int64_t whole(const TomlNode& node)
{
    return node.integer() != nullptr ? *node.integer() : static_cast<std::int64_t>(*node.floating());
}

inline Vec2 vector(const TomlNode& node)
{
    return {(*node.items())[0].number(), (*node.items())[1].number()};
}

inline StressDef stress(const TomlNode& node)
{
    const std::vector<TomlNode>& items = *node.items();
    return {items[0].number(), items[1].number(), items[2].number()};
}

/// @pre the value was checked against the key (find_complaint)
template <class T>
void store(T& field, const TomlNode& node, const KeySpec& key)
{
    if constexpr (IsOptional<T>::value)
        store(field.emplace(), node, key);
    else if constexpr (std::is_same_v<T, bool>)
        field = *node.boolean();
    else if constexpr (std::is_enum_v<T>)  // choices are listed in the order of the enumerators; KeySpec::ending comes last
        field = static_cast<T>(std::find(key.choices.begin(), key.choices.end(), *node.text()) - key.choices.begin());
    else if constexpr (std::is_integral_v<T>)
        field = static_cast<T>(whole(node));
    else if constexpr (std::is_same_v<T, double>)
        field = node.number();
    else if constexpr (std::is_same_v<T, std::string>)
        field = *node.text();
    else if constexpr (std::is_same_v<T, Vec2>)
        field = vector(node);
    else if constexpr (std::is_same_v<T, StressDef>)
        field = stress(node);
    else
    {
        field.clear();
        for (const TomlNode& item : *node.items())
            if constexpr (std::is_same_v<T, Polygon>)
                field.push_back(vector(item));
            else if constexpr (std::is_same_v<T, FactorTable>)
                field.push_back({(*item.items())[0].number(), (*item.items())[1].number()});
            else if constexpr (std::is_same_v<T, std::vector<int>>)
                field.push_back(static_cast<int>(whole(item)));
            else if constexpr (std::is_same_v<T, std::vector<double>>)
                field.push_back(item.number());
            else
                field.push_back(*item.text());
        if constexpr (std::is_same_v<T, Polygon>)
            if (field.size() > 1 && field.front() == field.back())  // a ring closed by hand
                field.pop_back();
    }
}

/// Points of a line; unlike those of a polygon, a last point that is the first stays.
template <auto Member>
void assign_line(void* object, const TomlNode& value, const KeySpec&)
{
    using Owner = typename MemberTraits<decltype(Member)>::Owner;
    Polygon& points = static_cast<Owner*>(object)->*Member;
    points.clear();
    for (const TomlNode& item : *value.items())
        points.push_back(vector(item));
}

inline std::string json_number(double x)
{
    return fmt::format("{}", x);
}

template <class T>
std::string json(const T& field, const std::vector<std::string>& choices)
{
    if constexpr (IsOptional<T>::value)
        return field ? json(*field, choices) : "";
    else if constexpr (std::is_same_v<T, bool>)
        return field ? "true" : "false";
    else if constexpr (std::is_enum_v<T>)
        return '"' + choices[static_cast<std::size_t>(field)] + '"';
    else if constexpr (std::is_integral_v<T>)
        return std::to_string(field);
    else if constexpr (std::is_same_v<T, double>)
        return json_number(field);
    else if constexpr (std::is_same_v<T, std::string>)
        return field.empty() ? "" : '"' + field + '"';
    else if constexpr (std::is_same_v<T, Vec2>)
        return fmt::format("[{}, {}]", json_number(field.x()), json_number(field.y()));
    else if constexpr (std::is_same_v<T, StressDef>)
        return fmt::format("[{}, {}, {}]", json_number(field.xx), json_number(field.yy), json_number(field.xy));
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
        return field.empty() ? "" : fmt::format("[\"{}\"]", fmt::join(field, "\", \""));
    else
        return "";
}

/// What a table entry says besides its field.
struct Say
{
    const char* name;
    const char* unit = "";
    const char* effect = "";
    const char* example = "";
    Range range = {};
    std::vector<std::string> choices = {};
    bool required = false;
    const char* default_note = "";
    const char* ending = "";
};

inline KeySpec spec(Say say, ValueType type)
{
    KeySpec key;
    key.name = say.name;
    key.type = type;
    key.unit = say.unit;
    key.effect = say.effect;
    key.example = say.example;
    key.range = say.range;
    key.choices = std::move(say.choices);
    key.ending = say.ending;
    key.required = say.required;
    key.default_note = say.default_note;
    return key;
}

template <auto Member>
KeySpec field(Say say)
{
    using Owner = typename MemberTraits<decltype(Member)>::Owner;
    using Type = typename MemberTraits<decltype(Member)>::Type;
    KeySpec key = spec(std::move(say), type_of<Type>());
    if (!key.required && key.default_note.empty())
        key.default_json = json(Owner{}.*Member, key.choices);
    key.assign = [](void* object, const TomlNode& value, const KeySpec& k)
    { store(static_cast<Owner*>(object)->*Member, value, k); };
    return key;
}

/// The same for a field of a struct inside the section's struct.
template <auto Outer, auto Member>
KeySpec inner_field(Say say)
{
    using Owner = typename MemberTraits<decltype(Outer)>::Owner;
    KeySpec key = field<Member>(std::move(say));
    key.assign = [](void* object, const TomlNode& value, const KeySpec& k)
    { store((static_cast<Owner*>(object)->*Outer).*Member, value, k); };
    return key;
}

/// Opens a new entry of a list of the case.
template <auto List>
void* append(CaseDef& def, const std::string& name)
{
    auto& entry = (def.*List).emplace_back();
    if constexpr (requires { entry.name; })
        entry.name = name;
    return &entry;
}

/// Opens a part of the case that occurs once.
template <auto Part>
void* part(CaseDef& def, const std::string&)
{
    return &(def.*Part);
}

inline void* whole_case(CaseDef& def, const std::string&)
{
    return &def;
}

inline KeySpec with_assign(KeySpec key, void (*assign)(void*, const TomlNode&, const KeySpec&), const char* default_json = "")
{
    key.assign = assign;
    key.default_json = default_json;
    return key;
}
}  // namespace hdem::fields
