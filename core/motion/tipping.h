#pragma once
/// Blocks that tip over or roll.

#include "core/model/model.h"
#include "core/motion/moving_groups.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Does the block turn on about what bears it, by its weight, and come to rest on nothing of it?
///
///   (g x r) w > 0    for each point at r from the centroid that bears it, and for the far end of each face that comes down
///
/// All points lie in one place, or on one face that sticks by most of its force. So a block tips away from where it stood, and rolls over a face that its weight passes. One that comes back to its face is damped: a
/// block that rocks or hops comes to rest. So is one that slides there while the force of the joint turns it back: it would tip if it stuck.
/// @param rule  the rim is faster; do blocks that roll count?
[[nodiscard]] bool tips(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks, const Contacts& contacts,
                        const BlockContacts& list);
}  // namespace hdem
