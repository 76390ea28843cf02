#pragma once
/// How hard the sides of a block are pressed.

#include "core/state/blocks.h"
#include "core/state/contacts.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Are forces noted in the cycle that follows so many cycles of the stage? Often at first, when blocks give way to new loads, later now and then: a note costs half of a cycle's
/// time.
[[nodiscard]] bool notes_bearing_forces(std::int64_t cycles_of_stage);

/// Note for each block of `range` the sum of the normal forces by which springs press it. It says how far the block is pressed into what bears it
/// (core/detection/corner_beside_corner.h). Notes are a part of the state: the search of features may not read forces of other contacts, which other threads are changing.
/// Reads: contacts of this cycle. Writes: bearing_force of these blocks.
void note_bearing_forces(IndexRange range, const BlockContacts& list, const Contacts& contacts, Blocks& blocks);
}  // namespace hdem
