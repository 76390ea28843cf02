#pragma once
/// The contact stage of a cycle: overlaps, regime and force of a range of contacts.

#include "core/contact/regime.h"
#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <limits>

namespace hdem
{
/// What a pass does besides the laws. What is not needed can be left out: the results are the same, and a third less memory is touched.
struct PassNeeds
{
    bool views =
        true;  ///< look whether incident vertices have left the places at which features were found; false: none has, and no flag is written
    bool rests = true;  ///< some contact may have a rest overlap
    bool tilts = true;  ///< store tilt forces: they are read before the next pass
    /// Contacts from here on are another thread's: to prefetch their data would take them from its cache.
    Index own_end = std::numeric_limits<Index>::max();
};

/// Reads:  motion and inertia of the blocks; features and history of the contacts in `range`.
/// Writes: history (forces and regimes) and staleness of these contacts, their entries in `loads`.
/// Contacts do not depend on each other: any split into ranges gives the same bits. A range begins at a multiple of `lanes`; it ends at one,
/// or with the last contact.
///
/// Steps 1-3 of a cycle: overlap, length and relative velocity from the stored features (Eq. 3), regime (Eqs. 24-28),
/// spring forces (Eqs. 5-10). A point in the impulse regime gets no spring force here: core/contact/impulse_law.h.
/// @return  `sums` and what this range adds
ContactTally evaluate_contacts(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads, const ContactTally& sums = {}, const PassNeeds& needs = {});

/// Store the tilt forces that the last pass over `range` found but did not store: the same bits.
/// @pre  blocks have not moved since
void store_tilt_forces(IndexRange range, const Blocks& blocks, Contacts& contacts);
}  // namespace hdem
