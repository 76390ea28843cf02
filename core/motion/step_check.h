#pragma once
/// Checks during a run whether the step is too large for the springs that act. At the start of a run, only the contacts of the start are known.

#include "core/contact/regime.h"
#include "core/model/model.h"
#include "core/motion/time_step.h"
#include "core/state/state.h"

namespace hdem
{
/// A contact that may be too stiff for the step by itself once it closes.
struct StiffContact
{
    Index contact = no_index;
    bool acts = false;  ///< its springs gave forces in the last cycle
};

/// Collect the contacts of `range` that may be too stiff in `stiff`: none in most models. For a contact of two blocks of mass m, inertia I and radius r, no
/// matter where they touch, the trace of M^-1 K gives
///
///   omega_max^2 <= max(K_N, K_S) L  sum over both of (2 / m + r^2 / I)         L the diameter of the smaller
void find_stiff_contacts(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                         std::vector<StiffContact>& stiff);

/// Greatest share of an overlap that one spring of `range` may remove by itself in a cycle, over the square of the step [1/s2]. Counted with all blocks free and the
/// stiffest joint everywhere, so that it is the same for as long as the pairs are.
[[nodiscard]] double greatest_answer(IndexRange range, const Model& model, const Contacts& contacts);

/// Which springs must be checked for closing and opening: all, if one may by itself remove more than 0.3 of an overlap in a cycle. Slower springs take six
/// cycles or more to reverse a motion. (The share is 0.1 to 0.3 with Eq. (32)'s step, and 2 for needles of 1:100.)
[[nodiscard]] inline Closing closing_of(double greatest_answer, double step)
{
    return greatest_answer * step * step > 0.3 ? Closing::all_points : Closing::fast_points;
}

/// First contact whose springs have begun to act in this cycle although its own 2 / omega_max is below the step; no_index: none. Other contacts of its blocks
/// can only raise omega_max. An impact at such a step lasts one or two cycles and throws the blocks apart, so it must be found in that cycle.
/// @pre  poses are those at which the contacts were evaluated
[[nodiscard]] Index find_unstable(const Model& model, const Blocks& blocks, const Contacts& contacts,
                                  std::vector<StiffContact>& stiff);

/// Stable limit of the springs of one contact that gave forces in the last cycle, without all others [s].
[[nodiscard]] double contact_limit(const Model& model, const Blocks& blocks, const Contacts& contacts, Index contact);

/// Stable limit of all springs that gave forces in the last cycle, where `step` exceeds it for certain; else infinite.
[[nodiscard]] StableLimit exceeded_limit(double step, const Model& model, const Blocks& blocks, const Contacts& contacts);
}  // namespace hdem
