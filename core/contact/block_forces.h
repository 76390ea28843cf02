#pragma once
/// What acts on each block: the loads of its contacts, its weight and loads from outside.

#include "core/model/model.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"
#include "core/state/workspace.h"

namespace hdem
{
/// List the contacts of each block, in their order.
void list_block_contacts(const Contacts& contacts, Index blocks, BlockContacts& list);

/// Weight and external forces of a block.
[[nodiscard, gnu::always_inline]] inline Triple weight_of(Index b, const Model& model, const std::vector<std::uint8_t>& present,
                                                          const std::vector<Triple>& external)
{
    const double mass = present[b] != 0 ? model.mass[b] : 0.0;
    Triple weight{mass * model.gravity.x(), mass * model.gravity.y(), 0.0};
    if (!external.empty())
    {
        weight.x += external[b].x;
        weight.y += external[b].y;
        weight.w += external[b].w;
    }
    return weight;
}

/// Square of the load from which on a joint of a block counts as in use: a thousandth of the block's weight [N2].
/// Before rock has settled, many joints bear only round-off, 100 km from the origin up to a ten-thousandth of a weight. Round-off may use up the whole of a tiny
/// strength; it would then choose the joint along which the block is damped, and whether it is.
[[nodiscard, gnu::always_inline]] inline double least_joint_load(const Triple& weight)
{
    return 1e-6 * (weight.x * weight.x + weight.y * weight.y);
}

/// What acts on each block of `range`: its weight, `external` forces (none: empty), then the loads of its contacts in their order, Eqs. (7), (8).
/// Reads: loads. Writes: force of these blocks; which joint is mobilised most only if `find_joint`, see needs_joint.
void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, bool find_joint, Blocks& blocks);
}  // namespace hdem
