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

/// What acts on each block of `range`: its weight, `external` forces (none: empty), then the loads of its contacts in their order, Eqs. (7), (8).
/// Reads: loads. Writes: force of these blocks; which joint is mobilised most only if `find_joint`, see needs_joint.
void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, bool find_joint, Blocks& blocks);
}  // namespace hdem
