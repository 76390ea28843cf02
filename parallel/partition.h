#pragma once
/// Contacts and blocks cut into pieces of work, and colours for pieces that must not run at the same time.

#include "core/contact/impulse_islands.h"
#include "core/contact/regime.h"
#include "core/model/model.h"
#include "core/motion/step_check.h"
#include "core/motion/step_control.h"
#include "core/state/energy_terms.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <limits>

namespace hdem
{
/// Contacts that follow each other. Contacts are sorted by their blocks, and blocks along a space-filling curve, so that a part is a patch of
/// the model that fits a cache. Its size does not depend on the number of threads.
inline constexpr Index largest_part = 128;  ///< contacts; a multiple of that of any pack; 35 kB with their blocks

struct ContactPart
{
    IndexRange range;
    IndexRange blocks;                   ///< of these contacts, in Partition::blocks_of_contacts
    ContactTally tally;                  ///< of this cycle
    Index searched = 0;                  ///< features searched in this cycle
    EnergyLedger ledger;                 ///< of this cycle
    std::vector<ImpulsePoint> impulses;  ///< of this cycle
    MassRange masses;                    ///< of their blocks
    bool is_hit = false;                 ///< at one of them blocks hit each other
    bool unsolved = false;               ///< they need more than sweeps
    std::vector<IndexRange> active;      ///< contacts that are not left out, see core/motion/rest.h
    bool is_whole = true;                ///< none is left out
    bool is_woken = false;               ///< blocks of theirs were woken in the last cycle
    std::vector<StiffContact> stiff;     ///< to be looked at in every cycle
    Index unstable = no_index;           ///< of these, found in this cycle
    double answer = 0.0;                 ///< greatest_answer of its springs [1/s2]
    // What the next pass over this part need not do, see PassNeeds.
    bool rests = true;           ///< some contact may have a rest overlap
    double farthest_view = 0.0;  ///< no vertex is farther from its edge's start [m]
    double view_way =
        0.0;  ///< how far any incident vertex moves, as seen from its edge, while no block uses up more than its margin [m]
    double seen_until = -1.0;  ///< until blocks have used up so many margins since the run began no features can be stale

    /// Forget what is known of the contacts.
    void forget();
    /// The contacts have been looked at. @param gone  margins that blocks have used up since the run began
    void remember(double gone);
};

inline constexpr double unknown_speed = std::numeric_limits<double>::infinity();

inline constexpr Index blocks_a_part = 64;

struct BlockPart
{
    IndexRange range;
    std::vector<IndexRange> active;  ///< blocks that are not left out
    std::vector<Index> woken;        ///< in this cycle
    bool is_woken = false;           ///< their contacts with other blocks were, in the last cycle
    std::vector<Index> summed;       ///< blocks whose sums do not form part by part, see RunningSums
    std::vector<Index> flying;       ///< blocks with nothing near them
    std::vector<Index> fast;         ///< blocks that may fall or slide together; empty where this cycle looks at known groups alone
    std::vector<Index> pushed;       ///< blocks on which constant forces of sides act
    std::vector<Index> walls;        ///< that move
    std::vector<Index> bolted;       ///< blocks that bolts hold: these never rest
    bool rest_changed = false;       ///< blocks have been stopped or woken
    EnergyLedger ledger;             ///< of this cycle
    double way = 0.0;                ///< no point of these blocks went farther in this cycle, as a share of the block's margin
    StepBound step;                  ///< of these blocks
    double speed_squared = unknown_speed;  ///< of the fastest of these blocks or its rim, when they last moved [m2/s2]
};

struct Partition
{
    std::vector<ContactPart> contacts;
    std::vector<BlockPart> blocks;
    std::vector<Index> blocks_of_contacts;  ///< of each contact part, ascending, part after part
    /// Numbers of contact parts: two of one colour share no movable block. Whatever the number of threads, impulses are swept colour after colour.
    std::vector<std::vector<Index>> colours;
    IslandFinder island_finder;
    std::vector<Island> islands;  ///< of this cycle's impulses
};

/// Parts for the present contacts and blocks; `with_colours`: only impulses need them.
void make_partition(const State& state, bool with_colours, Partition& partition);

/// Blocks, farthest_view and view_way of all contact parts. @pre margins of blocks are those until contacts are found anew
void look_at_blocks(const Model& model, const State& state, Partition& partition);
}  // namespace hdem
