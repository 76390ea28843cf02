#pragma once
/// Work of springs along velocities that only correct positions.

#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
[[nodiscard]] inline bool is_moved(const Triple& v)
{
    return v.x != 0.0 || v.y != 0.0 || v.w != 0.0;
}

/// Work per second of the normal springs' last forces along such velocities, one entry a block [W].
[[nodiscard]] double normal_power(IndexRange range, const Contacts& contacts, const Blocks& blocks,
                                  const std::vector<Triple>& velocity);
}  // namespace hdem
