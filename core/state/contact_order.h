#pragma once
/// The order of contacts in their list: by parts, and within short stretches those that bear nothing last and the others by joint law.

#include "core/model/model.h"
#include "core/state/contacts.h"

#include <vector>

namespace hdem
{
/// Length of these stretches: what one thread takes at a time, parallel/partition.h.
inline constexpr Index contacts_a_stretch = 128;

/// Put contacts into the list from place `first` on, in their order, but within each stretch first those that may bear: packs of those that do not are passed over.
void put_bearing_first(const std::vector<Contact>& contacts, Index first, Contacts& list);

/// Bring contacts of one kind together within each stretch, so that most packs hold one kind: those that may bear by their laws, then the others. Contacts of one kind keep
/// their order; all laws without a memory are one.
void group_alike(const JointTable& joints, Contacts& contacts);

/// Number of contacts that may bear behind one that does not, in their stretch.
[[nodiscard]] Index count_misplaced(const Contacts& contacts);

/// Numbers of the contacts in the order of their parts. Fast for lists whose stretches are in that order.
[[nodiscard]] std::vector<Index> order_by_parts(const Contacts& contacts);
}  // namespace hdem
