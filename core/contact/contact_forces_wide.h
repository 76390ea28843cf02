#pragma once
/// The contact stage on processors with AVX-512, eight contacts at a time.

#include "core/contact/contact_forces.h"
#include "core/energy_ledger.h"

namespace hdem
{
/// Does this processor have what evaluate_by_eight needs, and was it built?
[[nodiscard]] bool has_wide_packs();

/// The bits of four contacts at a time.
/// @pre  has_wide_packs(), `range` has a multiple of eight contacts (with those that fill the arrays up), and each eight of them are plain, or all of one
/// law and curve that is not the user's (suit_wide_packs in contact_forces.cpp)
[[nodiscard]] ContactTally evaluate_by_eight(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                                             Contacts& contacts, ContactLoads& loads, const ContactTally& sums,
                                             const PassNeeds& needs);

/// Of stored_energy.
/// @pre  as above; any laws
void add_spring_energies_by_eight(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                                  SpringEnergies& sums);
}  // namespace hdem
