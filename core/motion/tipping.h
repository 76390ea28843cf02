#pragma once
/// Blocks that tip over or roll.

#include "core/model/model.h"
#include "core/motion/contact_tie.h"
#include "core/motion/fast_blocks.h"

#include <vector>

namespace hdem
{
/// Does a group turn on, as one block, about what bears it, by its weight, and come to rest on nothing of it?
///
///   (g x r) w > 0    for each point at r from the centroid that bears it, and for the far end of each face that comes down
///
/// All points lie in one place, or, for one block, on one face that sticks by most of its force. So blocks tip away from where they stood, and one rolls over a face that its weight passes. What comes back to its
/// face is damped: a block that rocks or hops comes to rest. So is what slides there while the force of the joint turns it back: it would tip if it stuck.
/// @param group  ascending: blocks that stick to each other
/// @param rule  a rim is faster; does a block that rolls count?
[[nodiscard]] bool tips(const std::vector<Index>& group, const Model& model, const GroupRule& rule, const ContactTies& ties);
}  // namespace hdem
