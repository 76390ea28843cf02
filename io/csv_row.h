#pragma once
/// Rows of tables with commas, as spreadsheets and maps write them.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hdem
{
/// The columns without blanks and quotes around them. A comma between quotes is text.
[[nodiscard]] std::vector<std::string> csv_columns(std::string_view row);

/// The whole column is a finite number.
[[nodiscard]] bool read_csv_number(std::string_view column, double& x);

struct CsvColumn
{
    std::string_view name;  ///< empty: any text
    std::string_view unit;  ///< that may stand behind it: "x [m]"
};

/// Heading of a table: the first of these columns, in this order, in capitals or not.
[[nodiscard]] bool is_csv_heading(std::span<const std::string> columns, std::span<const CsvColumn> names);

/// In capitals or not.
[[nodiscard]] bool is_same_word(std::string_view text, std::string_view word);

/// The file has this ending, in capitals or not.
[[nodiscard]] bool has_ending(std::string_view file_name, std::string_view ending);
}  // namespace hdem
