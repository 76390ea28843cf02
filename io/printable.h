#pragma once
/// Texts that others wrote, as a terminal may be sent them.

#include <string>
#include <string_view>

namespace hdem
{
/// The text with every control character but line ends and tabs replaced by its code, as \x1b: C0, DEL, C1 (also in UTF-8), and the marks that
/// turn the direction of writing. A terminal would obey them: move, hide or colour what stands beside them. Bytes that are not UTF-8 are
/// replaced in the same way.
[[nodiscard]] std::string printable(std::string_view text);
}  // namespace hdem
