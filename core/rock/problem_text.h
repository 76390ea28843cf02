#pragma once
/// Numbers and points in the text of a Problem.

#include "core/types.h"

#include <array>
#include <charconv>
#include <string>

namespace hdem
{
/// Six digits, whatever the locale.
[[nodiscard]] inline std::string text(double value)
{
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6).ptr;
    return {buffer.data(), end};
}

[[nodiscard]] inline std::string text(const Vec2& point)
{
    return "(" + text(point.x()) + ", " + text(point.y()) + ")";
}
}  // namespace hdem
