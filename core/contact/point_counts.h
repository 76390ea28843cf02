#pragma once

#include "core/state/contacts.h"

#include <array>

namespace hdem
{
/// Contact points by regime; open ones are not counted.
[[nodiscard]] std::array<Index, 4> count_points(const Contacts& contacts);
}  // namespace hdem
