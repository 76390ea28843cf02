#pragma once
/// For messages: which of the names did the user mean?

#include <string>
#include <string_view>
#include <vector>

namespace hdem
{
/// The name that differs from the word by the fewest letters, at most by a third of them; "" where none is near.
[[nodiscard]] std::string nearest_name(std::string_view word, const std::vector<std::string>& names);
}  // namespace hdem
