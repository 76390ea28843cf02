#pragma once
/// How contacts tie blocks that move.

#include "core/detection/edge_touch.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"
#include "core/state/workspace.h"

#include <cstddef>

namespace hdem
{
/// How a closed contact point ties its blocks.
enum class Tie
{
    none,  ///< bears nothing
    sticks,
    slides
};

/// More blocks that stick to each other than these are rock: they are not taken for one body.
inline constexpr std::size_t most_blocks_of_body = 64;

/// The ties of blocks in the running cycle.
struct ContactTies
{
    const Blocks& blocks;
    const Contacts& contacts;
    const BlockContacts& list;
    double fast;  ///< by impulses a point slides from this speed on [m/s]

    /// Of one end of a contact.
    [[nodiscard]] Tie at(Index contact, int end) const;

    /// Is this the tie of one of its ends?
    [[nodiscard]] bool is_somewhere(Tie tie, Index contact) const { return at(contact, 0) == tie || at(contact, 1) == tie; }

    /// The faces of a contact where its blocks are now.
    [[nodiscard]] EdgeTouch touch(Index contact) const;

    /// Do the blocks of this contact move together? Where a point is closed and does not slide.
    [[nodiscard]] bool are_together(Index contact) const;

    /// Is one of its points closed?
    [[nodiscard]] bool do_touch(Index contact) const { return (contacts.regime[0][contact] | contacts.regime[1][contact]) != 0; }

    [[nodiscard]] Index other_block(Index block, Index contact) const
    {
        return contacts.ref[contact] == block ? contacts.inc[contact] : contacts.ref[contact];
    }

    /// All contacts of a block.
    /// @param take  (contact, other block)
    template <typename Take>
    void for_contacts(Index block, const Take& take) const
    {
        for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
            take(list.entry[e] / 2, other_block(block, list.entry[e] / 2));
    }

    /// Does one of its contacts pass the test?
    /// @param test  (contact, other block)
    template <typename Test>
    [[nodiscard]] bool any_contact(Index block, const Test& test) const
    {
        for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
            if (test(list.entry[e] / 2, other_block(block, list.entry[e] / 2)))
                return true;
        return false;
    }
};
}  // namespace hdem
