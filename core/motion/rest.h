#pragma once
/// Blocks that have come to rest are left out of the cycle until what they carry changes.

#include "core/model/model.h"
#include "core/state/energy_terms.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <limits>

namespace hdem
{
/// Limits below which a block counts as resting. Values are the speed of a block's rim, and its net force and moment as an acceleration of the rim
/// (motion/equilibrium.h).
///
/// A block that is quiet at eight checks in a row is stopped: its last kinetic energy goes to local damping, its velocity is set to zero, its pose and contact forces
/// stay frozen. Contacts between blocks that are stopped, or fixed, give the same forces in every cycle and are not evaluated again. A block is woken in the
/// cycle in which its unbalance reaches `waking`, or an impulse reaches it.
/// While some blocks still move, these limits are wide. When none moves, they are below those with which a stage may end (core/stage/rules.cpp).
struct RestRule
{
    bool leaves_out = false;                                            ///< skip resting blocks
    double quiet_speed = 0.0;                                           ///< [m/s]
    double quiet = 0.0;                                                 ///< at each check [m/s2]
    double quiet_on_average = std::numeric_limits<double>::infinity();  ///< over the checks [m/s2]
    double waking = 0.0;                                                ///< [m/s2]
    double quiet_at_end = 0.0;                                          ///< `quiet` when no block moves any more [m/s2]
};
inline constexpr std::int64_t rest_every = 16;  ///< cycles between checks

/// Stop quiet blocks of `range`, wake others; forces are those of this cycle, velocities those of the last.
/// @param woken  the blocks that are woken are added to it
/// @return  whether contacts or blocks may be left out, or must be taken in again, from the next cycle on
bool update_rest(IndexRange range, const Model& model, const RestRule& rule, std::int64_t cycle, Blocks& blocks,
                 EnergyLedger& ledger, std::vector<Index>& woken);

/// Which blocks and contacts are left out is looked at as a whole in cycles in which stopped blocks have just become left out. In between only what is woken is taken in
/// again: to evaluate a contact at rest once more changes nothing.
[[nodiscard]] constexpr bool looks_at_rest(std::int64_t cycle)
{
    return cycle % rest_every == 2;
}

/// All blocks take part again.
void wake_all(Blocks& blocks);

/// Does no free block take part any more? Blocks of `taking_part` (ascending) always do: these need to be as quiet as others that are stopped.
[[nodiscard]] bool all_rest(const Model& model, const RestRule& rule, const std::vector<Index>& taking_part, const Blocks& blocks);

/// Wake stopped blocks whose unbalance is `limit` [m/s2] or more; for a stage that may not end yet.
/// @return  whether there are any
bool wake_unbalanced(const Model& model, double limit, Blocks& blocks);

/// Does the block take part, or touch or nearly touch a block that takes part?
[[nodiscard]] bool is_beside_moving(Index block, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks);

/// Groups of `lanes` contacts, or of blocks, of `range` that are not left out.
void find_active_contacts(IndexRange range, const Blocks& blocks, const Contacts& contacts, std::vector<IndexRange>& active);
void find_active_blocks(IndexRange range, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks,
                        std::vector<IndexRange>& active);
}  // namespace hdem
