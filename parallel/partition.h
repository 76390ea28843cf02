#pragma once
/// Contacts and blocks cut into pieces of work, and colours for pieces that must not run at the same time.

#include "core/contact/regime.h"
#include "core/motion/pace.h"
#include "core/motion/step_check.h"
#include "core/state/energy_terms.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// Contacts that follow each other. Contacts are sorted by their blocks, and blocks along a space-filling curve, so that a part is a patch of
/// the model that fits a cache. Its size does not depend on the number of threads.
struct ContactPart
{
    IndexRange range;
    ContactTally tally;                     ///< of this cycle
    Index searched = 0;                     ///< features searched in this cycle
    EnergyLedger ledger;                    ///< of this cycle
    std::vector<ImpulsePoint> impulses;     ///< of this cycle
    std::vector<IndexRange> active;         ///< contacts that are not left out, see core/motion/rest.h
    std::vector<StiffContact> stiff;        ///< to be looked at in every cycle
    Index unstable = no_index;              ///< of these, found in this cycle
    Closing closing = Closing::all_points;  ///< of springs outside of stages that have whole cycles
};

struct BlockPart
{
    IndexRange range;
    std::vector<IndexRange> active;  ///< blocks that are not left out
    bool rest_changed = false;       ///< what is left out is to be found anew
    EnergyLedger ledger;             ///< of this cycle
    double way = 0.0;                ///< no point of these blocks went farther in this cycle, as a share of the block's margin
    StandingRock standing;
    double pace_bound = 0.0;   ///< of the loose blocks that move
    double stable_step = 0.0;  ///< [s]
};

struct Partition
{
    std::vector<ContactPart> contacts;
    std::vector<BlockPart> blocks;
    /// Numbers of contact parts: two of one colour share no movable block. Whatever the number of threads, impulses are swept colour after colour.
    std::vector<std::vector<Index>> colours;
};

/// Parts for the present contacts and blocks; `with_colours`: only impulses need them.
void make_partition(const State& state, bool with_colours, Partition& partition);
}  // namespace hdem
