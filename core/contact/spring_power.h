#pragma once
/// What springs do against velocities that are no motion of the run: position corrections.

#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
[[nodiscard]] inline bool is_moved(const Triple& v)
{
    return v.x != 0.0 || v.y != 0.0 || v.w != 0.0;
}

/// Work per second of the springs' last forces along such velocities, of the normal and of the shear springs [W].
struct SpringPower
{
    double normal = 0.0;
    double shear = 0.0;
};
/// `velocity`: one entry a block.
[[nodiscard]] SpringPower spring_power(IndexRange range, const Contacts& contacts, const Blocks& blocks,
                                       const std::vector<Triple>& velocity);
}  // namespace hdem
