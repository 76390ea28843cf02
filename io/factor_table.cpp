#include "io/factor_table.h"

#include "io/scanner.h"
#include "io/toml_tree.h"

#include <fmt/format.h>

#include <optional>

namespace hdem
{
namespace
{
constexpr std::size_t most_rows = 1'000'000;
constexpr double largest = 1e18;

std::optional<TableColumn> heading(std::string_view line)
{
    const auto comma = line.find(',');
    if (comma == std::string_view::npos || trimmed(line.substr(comma + 1)) != "factor")
        return std::nullopt;
    const std::string_view first = trimmed(line.substr(0, comma));
    if (first == "cycle")
        return TableColumn::cycle;
    return first == "time" ? std::optional(TableColumn::time) : std::nullopt;
}

/// "" or what is wrong with the line.
std::string read_row(std::string_view line, FactorTable& rows)
{
    const auto comma = line.find(',');
    std::array<double, 2> row{};
    for (const int k : {0, 1})
    {
        Scanner column{trimmed(comma == std::string_view::npos ? line : (k == 0 ? line.substr(0, comma) : line.substr(comma + 1)))};
        const std::string text(trimmed(line));
        if (comma == std::string_view::npos || !column.take_number(row[static_cast<std::size_t>(k)]) || !column.rest.empty())
            return fmt::format("expected two numbers, got \"{}\"). Write cycle,factor or time,factor with points as decimal marks.",
                               printable(text, 20));
        if (!(row[static_cast<std::size_t>(k)] <= largest && row[static_cast<std::size_t>(k)] >= -largest))
            return fmt::format("\"{}\" is too great). Give at most {}.", printable(text, 20), largest);
    }
    if (!rows.empty() && row[0] <= rows.back()[0])
        return fmt::format("{} comes after {}). Sort the rows, and keep one for each cycle or time.", row[0], rows.back()[0]);
    rows.push_back(row);
    return "";
}
}  // namespace

FactorFile read_factors(std::istream& in, const std::string& file_name)
{
    FactorFile result;
    const auto complain = [&](int line, const std::string& why) {
        result.problems.push_back({Problem::Severity::error, "", fmt::format("{}:{}: factors: line ({}", file_name, line, why)});
    };
    bool has_heading = false;
    const auto add = [&](int line, std::string_view text)
    {
        if (!has_heading)
        {
            const std::optional<TableColumn> by = heading(text);
            if (!by)
                complain(line,
                         fmt::format("the heading is \"{}\"). Write cycle,factor or time,factor first.", printable(text, 40)));
            result.by = by.value_or(TableColumn::cycle);
            has_heading = true;
        }
        else if (const std::string why = read_row(text, result.rows); !why.empty())
            complain(line, why);
        if (result.rows.size() > most_rows)
            complain(line, fmt::format("more than {} rows). Give fewer: it is linear between rows.", most_rows));
        return result.problems.empty();
    };
    int last = 0;
    if (const std::string why = read_lines(in, last, add); !why.empty())
        complain(last, why);
    if (result.rows.size() < 2 && result.problems.empty())
        complain(last, fmt::format("the file has {} rows). Give two at least.", result.rows.size()));
    return result;
}

std::size_t first_unsorted(const FactorTable& rows)
{
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (!(rows[i][0] > rows[i - 1][0]))
            return i;
    return 0;
}
}  // namespace hdem
