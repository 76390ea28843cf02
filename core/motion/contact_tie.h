#pragma once
/// How contacts tie blocks that move.

#include "core/detection/edge_touch.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"

namespace hdem
{
/// How a closed contact point ties its blocks.
enum class Tie
{
    none,  ///< bears nothing
    sticks,
    slides
};

/// @param fast  by impulses a point slides from this speed on [m/s]
[[nodiscard]] Tie tie_of(Index contact, int end, double fast, const Blocks& blocks, const Contacts& contacts);

/// The faces of a contact where its blocks are now.
[[nodiscard]] EdgeTouch touch_of(Index contact, const Blocks& blocks, const Contacts& contacts);

/// Do the blocks of this contact move together? Where a point is closed and does not slide.
[[nodiscard]] bool are_together(Index contact, double fast, const Blocks& blocks, const Contacts& contacts);

[[nodiscard]] inline Index other_block(Index block, Index contact, const Contacts& contacts)
{
    return contacts.ref[contact] == block ? contacts.inc[contact] : contacts.ref[contact];
}

/// Is one of its points closed?
[[nodiscard]] bool do_touch(Index contact, const Contacts& contacts);
}  // namespace hdem
