#pragma once
/// The order of contacts in their list: by parts, and within short stretches by joint law.

#include "core/model/model.h"
#include "core/state/contacts.h"

#include <vector>

namespace hdem
{
/// Length of these stretches: what one thread takes at a time, parallel/partition.h.
inline constexpr Index contacts_a_stretch = 128;

/// Bring contacts of one law together within each stretch, so that most packs of four have one law. Contacts of one law keep their order, and so does a list
/// in which all have the same or none has a memory.
/// @pre  the list is sorted by parts
void group_by_law(const JointTable& joints, Contacts& contacts);

/// Numbers of the contacts in the order of their parts.
[[nodiscard]] std::vector<Index> order_by_parts(const Contacts& contacts);
}  // namespace hdem
