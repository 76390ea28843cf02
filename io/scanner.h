#pragma once
/// Reading lines and numbers of text files that others made: bounded, without exceptions, with words for what was found instead.

#include "core/types.h"

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace hdem
{
inline constexpr double farthest_coordinate = 1e8;  // [m], the same limit as in the case file

[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Whether a text begins with this word of capitals, itself in capitals or not.
[[nodiscard]] bool starts_with_word(std::string_view text, std::string_view word);

/// Reads a text from the left; every take_ either consumes or leaves the text as it is.
struct Scanner
{
    std::string_view rest;

    bool take(char c);
    /// A finite number that ends where a word ends.
    bool take_number(double& x);
    /// Points "x y, x y, ..." and the bracket behind them; returns what is wrong with them, or "".
    /// @param kind  of a point, for messages: "vertex"
    std::string take_points(Polygon& points, std::string_view kind);
    /// What comes next, for messages.
    [[nodiscard]] std::string here() const;
};

/// Calls `use` with the number and the text of every line that is neither empty nor a comment (#), until it returns false.
/// A mark of UTF-8 at the head of the file is left out.
/// @return "" or why reading stopped: a line or a file that is too long; `last` is the number of the last line seen
std::string read_lines(std::istream& in, int& last, const std::function<bool(int, std::string_view)>& use);
}  // namespace hdem
