#pragma once
/// A stage that looks for a state of rest: larger steps, and loose blocks ahead of the rock.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// In a stage that runs until it has converged, what is asked for is where blocks come to rest. A block of pace n makes n steps of its motion in one cycle:
///
///   m -> m / n^2,  I -> I / n^2,  v -> n v,  w -> n w       weight, springs and friction as they are
///
/// Its path, the work of every force on it, and its kinetic energy stay the same; what takes n cycles takes one. This is the density scaling of
/// quasi-static codes. In `motion` and `inertia` stand the scaled values; Blocks::velocity gives those of the user. There are two paces:
///
/// `rock`, of all blocks. Where the case gives no step, the rock takes a share of the largest that is stable: n dt <= stable_fraction * 2 / omega_max
/// (stable_step), found anew as contacts change, which may have grown longer by then. With a step given, or with loads, which are laid down in
/// cycles, it is 1. Where motions are prescribed both paces are 1.
///
/// `loose`, of blocks that moved more than `loose_distance` since the stage began, while the standing rock has come to rest: nearly all of it does within a
/// few thousand cycles, and then most cycles pass while single blocks slide out and fall. It is the greatest, up to 64, for which each loose block that moves
///
///   - has n w dt <= 1.4, stable beside another such block: w from its mass and the springs of all that touches it or is near;
///   - moves at most 1.5e-3 of its size a cycle, and with nothing near it a tenth of its margin;
///   - comes at most 1/20 nearer to what it is about to hit at more than 0.03 sqrt(g size): it hits with its true momentum, at the step of the rock.
///
/// One clock for all loose blocks keeps the order of events: with a clock each, a block that falls fast hits the rock before others have slid as far as they
/// should. The standing rock is at rest when its kinetic energy is below half of that of all free blocks at `mean_speed`: if loose blocks run ahead of
/// rock that still squeezes, it does not follow. As long as they run ahead the rock stands still, so that the time, which runs with them, is true for both.

/// Kinetic energy of the blocks that are not loose, and the mass of all free ones.
struct StandingRock
{
    double kinetic_energy = 0.0;  ///< [J]
    double free_mass = 0.0;       ///< [kg]
};

/// First: what each loose block by itself allows, into `bounds`; 0 for a block that is not loose.
StandingRock bound_paces(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts,
                         const Blocks& blocks, std::vector<double>& bounds);

/// Second: with what it touches, into `joined`.
/// @return the least of those that move, infinite without any
double join_bounds(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks,
                   const std::vector<double>& bounds, std::vector<double>& joined);

/// Pace of the loose blocks from that of the cycle before.
/// @param bound  the least of all that move
[[nodiscard]] double next_loose_pace(const Model& model, const Paces& last, const StandingRock& standing, double bound,
                                     bool may_grow);

/// Pace of the rock where `step` is the largest that is stable [s].
[[nodiscard]] double rock_pace(const Model& model, double step);

/// Third: that of each block.
void set_paces(IndexRange range, const Model& model, const Paces& paces, const std::vector<double>& joined, Blocks& blocks);

/// All blocks back to one step a cycle.
void reset_paces(const Model& model, State& state);

/// Can a block have this pace; can these be the two?
[[nodiscard]] bool is_pace(double pace);
[[nodiscard]] bool are_paces(const Paces& paces);

/// Does the present stage look for a state of rest? Then it runs until it has converged, with hdem's own damping.
[[nodiscard]] inline bool is_relaxing(const Model& model, const State& state)
{
    return state.damping == DampingPreset::automatic && state.stage_begun && model.stages[state.stage].until_converged;
}

/// A block with nothing near it may use up this share of its margin in a cycle. What it is about to hit is not known before its contacts are found anew:
/// in time, with this share of the margin left, and paces are then found anew in the same cycle.
inline constexpr double flight_share = 0.1;

/// Cycles between two updates, and between two at which paces may grow: longer than a block swings on its springs, so that one that rocks or
/// jolts stays with the rock.
inline constexpr std::int64_t pace_every = 4;
inline constexpr std::int64_t pace_growth_every = 16;
inline constexpr std::int64_t rock_pace_every = 256;
}  // namespace hdem
