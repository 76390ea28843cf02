#pragma once
/// Time steps of a stage that seeks a state of rest: as long as all blocks that move, or are about to move, allow.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <limits>

namespace hdem
{
/// How long the steps of a stage are.
struct StepRule
{
    bool varies = false;  ///< else all steps are those of the case
    bool keeps_given =
        false;  ///< the case gives the step: it is kept while standing rock moves faster than `slow`; loose blocks, and slow rock, may take longer steps
    bool flies_ahead = false;     ///< blocks with nothing near them take longer steps (core/motion/flight.h)
    double stable_share = 0.9;    ///< of the largest stable step [-]
    double falls_by = 0.0;        ///< where impulses alone carry blocks: what a block falls by between two of them [m/s2]
    double slow = 0.0;            ///< standing rock keeps the given step while it moves faster than this [m/s]
    double loose_distance = 0.0;  ///< a block that moved farther in its stage is loose [m]

    /// Is the case's own step never shortened, so that it must be stable?
    [[nodiscard]] bool needs_stable_step() const { return !varies || keeps_given; }
};

/// A bound on the stable step of one block, 2 / omega [s]: omega is at least that of the block on the springs of all that it touches or may touch before
/// the contacts are found anew, see stable_step (time_step.h).
///
/// Faces that lie over each other, closed or open, count as closed along their present length. Next to a block that has moved by more than a hundredth of
/// its size in its stage, an open contact may be closed along a whole side in the next cycle. It counts with the longest side that both parts have
/// and with the longest levers. So the step is short enough for an impact before it happens.
[[nodiscard]] double stable_step_of(Index block, const Model& model, const BlockContacts& list, const Contacts& contacts,
                                    const Blocks& blocks);

/// Set Blocks::stable_step to 0 (not known) where it is no longer valid. Only this function decides that. Values hold within one stage, from the cycle on in which
/// its steps vary: as long as steps do not vary, contacts change and the values are not updated. bound_steps finds the value of each block for which none is known.
/// @pre  before cycles run under this rule
void forget_stable_steps(const StepRule& rule, State& state);

/// Bounds on the next step from a range of blocks.
struct StepBound
{
    double touching = std::numeric_limits<double>::infinity();  ///< least of all others [s]
    double flying = std::numeric_limits<double>::infinity();    ///< least of loose blocks with nothing near them [s]
    bool standing_moves = false;                                ///< a block that is not loose is faster than slow

    [[nodiscard]] double least() const { return touching < flying ? touching : flying; }
    void add(const StepBound& other)
    {
        touching = other.touching < touching ? other.touching : touching;
        flying = other.flying < flying ? other.flying : flying;
        standing_moves = standing_moves || other.standing_moves;
    }
};

/// The least over all blocks of `range` that take part, or are beside one that does, of
///
///   stable_share stable_step_of      found anew if `look_at_all`, else from Blocks::stable_step; half of it, and always found anew, where only narrow contacts hold a block
///   1.5e-3 size / speed              of what moves and touches something; 0.02 with something near it
///   (1e-7 size / falls_by)^1/2       by impulses alone: a stack that falls by more between two of them would walk on its joints
///   0.1 margin / speed               of what moves with nothing near it: what it is about to hit is found in time
///   0.03 / swing_rate                of the same in water (core/water/water_motion.h)
[[nodiscard]] StepBound bound_steps(IndexRange range, const StepRule& rule, bool look_at_all, const Model& model,
                                    const BlockContacts& list, const Contacts& contacts, Blocks& blocks);

/// The next step: base 2^(k/8) with the greatest whole number k that the bound allows; at most twice as long as the last one.
[[nodiscard]] double next_step(double last, const StepBound& bound, const StepRule& rule, double base, bool may_grow);

/// Do blocks in flight go ahead of the others? Where only they move, the step itself grows instead.
[[nodiscard]] bool flies_ahead(const StepBound& bound, const StepRule& rule, double base);

/// Cycles between two looks at speeds, two at which the step may grow, and two at the stable step of all blocks.
inline constexpr std::int64_t look_every = 4;
inline constexpr std::int64_t grow_every = 16;
inline constexpr std::int64_t look_at_all_every = 256;

/// A block with nothing near it may use up this share of its margin in a cycle. What it is about to hit is not known before its contacts are found anew:
/// in time, with this share of the margin left, and the step is then found anew in the same cycle.
inline constexpr double flight_share = 0.1;
}  // namespace hdem
