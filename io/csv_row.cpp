#include "io/csv_row.h"

#include "io/scanner.h"

#include <fmt/format.h>

#include <algorithm>

namespace hdem
{
namespace
{
char small(char c)
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Takes a column between quotes, and the second of two quotes that stand for one.
std::string take_quoted(std::string_view& row)
{
    std::string column;
    for (row.remove_prefix(1); !row.empty(); row.remove_prefix(1))
    {
        if (row.front() == '"' && (row.size() < 2 || row[1] != '"'))
            break;
        if (row.front() == '"')
            row.remove_prefix(1);
        column += row.front();
    }
    row.remove_prefix(row.empty() ? 0 : 1);
    return column;
}
}  // namespace

bool is_same_word(std::string_view text, std::string_view word)
{
    return std::ranges::equal(text, word, [](char a, char b) { return small(a) == small(b); });
}

std::vector<std::string> csv_columns(std::string_view row)
{
    std::vector<std::string> columns;
    for (;;)
    {
        row = trimmed(row);
        std::string quoted = row.starts_with('"') ? take_quoted(row) : "";
        const auto comma = row.find(',');
        columns.push_back(quoted + std::string(trimmed(row.substr(0, comma))));
        if (comma == std::string_view::npos)
            return columns;
        row.remove_prefix(comma + 1);
    }
}

bool read_csv_number(std::string_view column, double& x)
{
    Scanner scan{column};
    return scan.take_number(x) && scan.rest.empty();
}

bool is_csv_heading(std::span<const std::string> columns, std::span<const CsvColumn> names)
{
    const auto says = [](std::string_view text, const CsvColumn& column)
    {
        if (column.name.empty())
            return true;
        if (text.size() < column.name.size() || !is_same_word(text.substr(0, column.name.size()), column.name))
            return false;
        const std::string_view unit = trimmed(text.substr(column.name.size()));
        return unit.empty() ||
               (!column.unit.empty() && (unit == fmt::format("[{}]", column.unit) || unit == fmt::format("({})", column.unit)));
    };
    return columns.size() <= names.size() && std::ranges::equal(columns, names.first(columns.size()), says);
}

bool has_ending(std::string_view file_name, std::string_view ending)
{
    return file_name.size() >= ending.size() && is_same_word(file_name.substr(file_name.size() - ending.size()), ending);
}
}  // namespace hdem
