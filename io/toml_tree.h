#pragma once
/// A TOML document as a plain tree in which every key and value knows where it stands. The only file of io that
/// includes the TOML library is toml_tree.cpp.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hdem
{
/// A place in one of the texts a case is made of; see CaseSource for what `source` means.
struct Place
{
    int line = 0;    ///< 1 = first; 0 = the text as a whole
    int column = 0;  ///< 1 = first; 0 = the line as a whole
    int source = 0;

    friend bool operator==(const Place&, const Place&) = default;
};

struct TomlMember;

struct TomlNode
{
    /// A date or time: legal TOML that no key of a case file takes.
    struct Date
    {
    };
    using Items = std::vector<TomlNode>;
    using Members = std::vector<TomlMember>;

    std::variant<Date, bool, std::int64_t, double, std::string, Items, Members> value;
    Place at;

    [[nodiscard]] const bool* boolean() const { return std::get_if<bool>(&value); }
    [[nodiscard]] const std::int64_t* integer() const { return std::get_if<std::int64_t>(&value); }
    [[nodiscard]] const double* floating() const { return std::get_if<double>(&value); }
    [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&value); }
    [[nodiscard]] const Items* items() const { return std::get_if<Items>(&value); }
    [[nodiscard]] const Members* members() const { return std::get_if<Members>(&value); }
    [[nodiscard]] Items* items() { return std::get_if<Items>(&value); }
    [[nodiscard]] Members* members() { return std::get_if<Members>(&value); }

    [[nodiscard]] bool is_number() const { return integer() != nullptr || floating() != nullptr; }
    /// @pre is_number()
    [[nodiscard]] double number() const;
    /// Value of this table's key, or nullptr.
    [[nodiscard]] const TomlNode* find(std::string_view key) const;
};

struct TomlMember
{
    std::string key;
    Place key_at;
    TomlNode value;
};

/// What is wrong with a text that is not TOML.
struct TomlError
{
    Place at;
    std::string why;
    std::string remedy;
};

/// Members are in the order of the text. Tables nest at most a few hundred deep, so that recursion over the tree is safe.
std::variant<TomlNode, TomlError> parse_toml(std::string_view text);

/// The value of `--set key=value`: a TOML value, or a bare word taken as a string. All places are {0, 0, source}.
std::variant<TomlNode, TomlError> parse_toml_value(std::string_view text, int source);

/// A value as it is shown in a message: short, on one line, without control characters.
std::string brief(const TomlNode& node);
/// Text without control characters, cut to a length that fits a message.
std::string printable(std::string_view text, std::size_t longest = 60);
}  // namespace hdem
