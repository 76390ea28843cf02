#include "io/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace hdem
{
namespace
{
/// A character and how many bytes it takes; no bytes when it is not UTF-8.
struct Character
{
    std::uint32_t code = 0;
    std::size_t bytes = 0;
};

Character first_character(std::string_view text)
{
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t head = byte(0);
    if (head < 0x80U)
        return {head, 1};
    const std::size_t bytes = head >= 0xf0U ? 4 : (head >= 0xe0U ? 3 : 2);
    if (head < 0xc2U || head > 0xf4U || text.size() < bytes)
        return {};
    std::uint32_t code = head & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i)
    {
        if ((byte(i) & 0xc0U) != 0x80U)
            return {};
        code = (code << 6U) | (byte(i) & 0x3fU);
    }
    return {code, bytes};
}

bool is_control(std::uint32_t code)
{
    const bool c0 = code < 0x20U && code != '\n' && code != '\t';
    const bool c1 = code >= 0x7fU && code < 0xa0U;
    const bool turns_writing = (code >= 0x202aU && code <= 0x202eU) || (code >= 0x2066U && code <= 0x2069U);
    return c0 || c1 || turns_writing;
}
}  // namespace

std::string printable(std::string_view text)
{
    const auto is_plain = [](char c) { return (c >= 0x20 && c < 0x7f) || c == '\n' || c == '\t'; };
    if (std::ranges::all_of(text, is_plain))  // nearly all are
        return std::string(text);
    std::string out;
    out.reserve(text.size());
    while (!text.empty())
    {
        const Character character = first_character(text);
        if (character.bytes == 0)
            out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
        else if (is_control(character.code))
            out += character.code < 0x100U ? fmt::format("\\x{:02x}", character.code) : fmt::format("\\u{:04x}", character.code);
        else
            out += text.substr(0, character.bytes);
        text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
    }
    return out;
}
}  // namespace hdem
