#pragma once
/// Blocks that have come to rest are left out of the cycle until what they carry changes.

#include "core/model/model.h"
#include "core/state/energy_terms.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// In a stage that looks for a state of rest (see motion/pace.h) most blocks have found theirs long before it ends. A block is quiet while
///
///   |v| + |w| r < 0.2 mean_speed     and     (|F| + |M| / r) 256 dt < 0.2 mean_speed m
///
/// r its radius, F and M the net force and moment on it, impulses included: it is slower than the criterion asks for, and will be for some time. (Where
/// `unbalanced_force_ratio` is a criterion, F is at most 5 % of that of the weight.) Quiet at eight checks in a row it is stopped: its last kinetic energy goes to local damping, its velocity is zero, its place and what it carries stay
/// to the bit. Contacts between blocks that are stopped, or fixed, give the same forces in every cycle and are not evaluated again. A block is woken in the very
/// cycle in which the net force on it grows to ten times that limit, or an impulse reaches it.
///
/// In the tunnel of the paper a block is stopped with 0.07 % of its weight out of balance at most and woken with ten times that, which presses 1e-6 m
/// into its joints; smaller criteria make both smaller. Rock that creeps on the verge of sliding is more sensitive: around a room that squeezed by 2 mm
/// blocks ended up to 0.7 mm elsewhere at four times these limits. With loads, whose schedule wakes nobody, or prescribed motions no block rests.
inline constexpr std::int64_t rest_every = 16;  ///< cycles between checks

/// Limits of a quiet block.
struct RestLimits
{
    double speed = 0.0;         ///< [m/s]
    double acceleration = 0.0;  ///< net force over mass [m/s2]
};
[[nodiscard]] RestLimits rest_limits(const Model& model);

/// Stop quiet blocks of `range`, wake others; forces are those of this cycle, velocities those of the last.
/// @param check  whether this is one of the cycles in which blocks are found quiet
/// @return  whether contacts or blocks are to be left out, or taken in again, from the next cycle on
bool update_rest(IndexRange range, const Model& model, const RestLimits& limits, bool check, Blocks& blocks, EnergyLedger& ledger);

/// All blocks take part again.
void wake_all(Blocks& blocks);

/// Does it touch, or nearly touch, a block that takes part, or take part itself?
[[nodiscard]] bool is_beside_moving(Index block, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks);

/// Groups of `lanes` contacts, or of blocks, of `range` that are not left out.
void find_active_contacts(IndexRange range, const Blocks& blocks, const Contacts& contacts, std::vector<IndexRange>& active);
void find_active_blocks(IndexRange range, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks,
                        std::vector<IndexRange>& active);
}  // namespace hdem
